// SPDX-License-Identifier: Apache-2.0
// What every part of the import of one file shares.
#pragma once

#include <filesystem>
#include <string>

#include "importers/pbrt/report.h"
#include "importers/pbrt/version.h"

namespace vitrail::pbrt {

struct Context {
  Version version = Version::v4;
  std::filesystem::path directory;  // of the main file
  Report report;

  // Where a file that the scene names is: beside the main file, or in the working directory.
  std::filesystem::path resolve(const std::string& name) const {
    const std::filesystem::path beside = directory / name;
    std::error_code ignored;
    return std::filesystem::exists(beside, ignored) || !std::filesystem::exists(name, ignored)
               ? beside
               : std::filesystem::path(name);
  }
};

}  // namespace vitrail::pbrt
