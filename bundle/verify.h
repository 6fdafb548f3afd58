// SPDX-License-Identifier: Apache-2.0
// This file reads the whole of a bundle and reports all that is wrong with it.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bundle/census.h"

namespace vitrail {

// A VerifyFinding is something wrong in a bundle.
struct VerifyFinding {
  std::string file;  // below the bundle's directory
  std::string what;
  auto operator<=>(const VerifyFinding&) const = default;
};

// They say how to check.
struct VerifyOptions {
  int threads = 0;                         // 0: one a processor allowed
  std::function<void(double)> progress{};  // told the fraction that is read, from any thread, one at a time
};

// It holds what a check found.
struct VerifyResult {
  std::vector<VerifyFinding> problems;  // by file
  std::vector<VerifyFinding> warnings;  // what does no harm: files that do not belong to the bundle
  std::uint64_t files = 0, bytes = 0;   // that were read
  double wall_s = 0;
  std::optional<CensusResult> census;  // of the domains; none where one of them is damaged
};

// Checks checksums, sizes, offsets and references of every file, each against the manifest, and counts that
// every triangle is stored once. A damaged file does not stop it. Where the manifest is damaged, the other
// files are still checked by themselves, and missing ones are reported. Throws Error where there is no
// directory.
VerifyResult verify_bundle(const std::filesystem::path& bundle, const VerifyOptions& options = {});

}  // namespace vitrail
