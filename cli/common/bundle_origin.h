// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace vitrail {

// A BundleOrigin says of which scene a bundle was made, by which program, with which options. It is for
// people alone: nothing depends on it.
struct BundleOrigin {
  std::string scene, program, options;
};

// Writes BUNDLE/origin.json; `program` is this one. Throws MachineError.
void write_bundle_origin(const std::filesystem::path& bundle, const BundleOrigin& origin);
// Returns the origin, empty where there is none.
BundleOrigin read_bundle_origin(const std::filesystem::path& bundle);

// Returns when a file was last written, "2026-07-11 10:00:00 UTC"; "" where that is unknown.
std::string time_of(const std::filesystem::path& file);

}  // namespace vitrail
