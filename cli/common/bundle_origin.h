// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace vitrail {

// Of which scene a bundle was made, by which program, with which options. For people alone: nothing depends
// on it.
struct BundleOrigin {
  std::string scene, program, options;
};

// BUNDLE/origin.json; `program` is this one. Throws MachineError.
void write_bundle_origin(const std::filesystem::path& bundle, const BundleOrigin& origin);
// Empty where there is none.
BundleOrigin read_bundle_origin(const std::filesystem::path& bundle);

// When a file was last written, "2026-07-11 10:00:00 UTC"; "" where that is unknown.
std::string time_of(const std::filesystem::path& file);

}  // namespace vitrail
