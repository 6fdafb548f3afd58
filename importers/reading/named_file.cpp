// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/named_file.h"

#include <algorithm>
#include <array>

namespace vitrail {

namespace {

bool is_same_name(const std::string& a, const std::string& b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower_case(x) == lower_case(y); });
}

// The one entry of its folder that differs in the letter case of its last part alone.
std::filesystem::path in_any_case(const std::filesystem::path& file) {
  std::error_code none;
  std::filesystem::path found;
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path(), none)) {
    if (!is_same_name(entry.path().filename().string(), file.filename().string())) continue;
    if (!found.empty()) return {};
    found = entry.path();
  }
  return found;
}

}  // namespace

char lower_case(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::string find_named_file(std::string name, const std::filesystem::path& folder) {
  const auto is_file = [](const std::filesystem::path& path) {
    std::error_code ignored;  // names too long for the file system are no files either
    return std::filesystem::is_regular_file(path, ignored);
  };
  const std::string given = name;
  std::ranges::replace(name, '\\', '/');
  const std::array names{given, name, name.substr(name.rfind('/') + 1)};
  for (const bool any_case : {false, true})
    for (const std::string& candidate : names) {
      if (candidate.empty()) continue;
      const std::filesystem::path whole = std::filesystem::absolute(folder / candidate).lexically_normal();
      const std::filesystem::path file = any_case ? in_any_case(whole) : whole;
      if (is_file(file)) return file.string();
    }
  return "";
}

std::string named_file(const std::string& name, const std::filesystem::path& folder) {
  const std::string found = find_named_file(name, folder);
  return found.empty() ? std::filesystem::absolute(folder / name).lexically_normal().string() : found;
}

}  // namespace vitrail
