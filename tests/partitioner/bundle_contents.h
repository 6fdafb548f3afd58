// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "bundle/manifest.h"

namespace vitrail::test {

// Beside those of domains: the manifest and its records.
inline constexpr std::size_t files_of_records = 1 + records_file_names.size();

// The files below a directory, by their names in it.
inline std::map<std::string, std::string> contents(const std::filesystem::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    std::ostringstream text;
    text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    files[std::filesystem::relative(entry.path(), directory).string()] = text.str();
  }
  return files;
}

}  // namespace vitrail::test
