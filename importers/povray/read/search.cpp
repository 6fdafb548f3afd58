// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/search.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>

namespace vitrail::pov {

namespace {

namespace fs = std::filesystem;

std::string lower(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

std::optional<fs::path> found_as(const Search& search, const fs::path& name) {
  std::error_code ignored;
  if (name.is_absolute()) return fs::is_regular_file(name, ignored) ? std::optional(name) : std::nullopt;
  for (const fs::path& folder : search.folders)
    if (fs::is_regular_file(folder / name, ignored)) return folder / name;
  return std::nullopt;
}

std::optional<fs::path> found_in_another_case(const Search& search, const fs::path& name) {
  std::error_code ignored;
  const std::string wanted = lower(name.filename().string());
  for (const fs::path& folder : search.folders)
    for (fs::directory_iterator entry(folder / name.parent_path(), ignored), end; !ignored && entry != end;
         entry.increment(ignored))
      if (lower(entry->path().filename().string()) == wanted) return entry->path();
  return std::nullopt;
}

}  // namespace

Search search_of(const fs::path& scene, const std::vector<std::string>& given) {
  Search search;
  search.folders.push_back(scene.parent_path());
  search.folders.insert(search.folders.end(), given.begin(), given.end());
  if (const char* const folders = std::getenv("POV_INC")) {
    std::istringstream list(folders);
    for (std::string folder; std::getline(list, folder, ':');)
      if (!folder.empty()) search.folders.emplace_back(folder);
  }
  for (const char* root : {"/usr/share/povray-3.7", "/usr/local/share/povray-3.7", "/usr/share/povray"})
    search.folders.push_back(fs::path(root) / "include");
  search.folders.emplace_back("/usr/share/fonts/truetype/povray");
  return search;
}

std::optional<fs::path> find(const Search& search, const std::string& name) {
  if (auto path = found_as(search, name)) return path;
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  if (auto path = found_as(search, slashes)) return path;
  return found_in_another_case(search, slashes);
}

}  // namespace vitrail::pov
