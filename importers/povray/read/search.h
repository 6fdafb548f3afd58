// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vitrail::pov {

// Files that a scene names are looked for in this order: beside the scene, in the given folders, in those of
// $POV_INC (separated by colons), in POV-Ray's own.
struct Search {
  std::vector<std::filesystem::path> folders;
};

Search search_of(const std::filesystem::path& scene, const std::vector<std::string>& given);

// Counts backslashes as slashes where there is no such file; then takes names in another case of letters.
std::optional<std::filesystem::path> find(const Search& search, const std::string& name);

}  // namespace vitrail::pov
