// SPDX-License-Identifier: Apache-2.0
// The documentation as its tests read it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::test {

struct PageLine {
  std::string text;
  int number = 0;
  bool is_code = false;   // indented by four columns after an empty line, or between fences
  bool is_typed = false;  // between ```sh and ```
};

// All pages of docs/ and of the root, and the README.md of every folder, by path.
std::vector<std::filesystem::path> pages();
std::vector<PageLine> lines_of(const std::filesystem::path& page);
// From the root of the source.
std::string name_of(const std::filesystem::path& page);

}  // namespace vitrail::test
