// SPDX-License-Identifier: Apache-2.0
#include "tests/docs/pages.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <fstream>

namespace vitrail::test {

namespace fs = std::filesystem;

namespace {

const fs::path root = source_dir();

// What is built, packed or checked out beside the source is no part of it.
bool is_foreign(const fs::path& folder) {
  const std::string name = folder.filename();
  return name.starts_with(".") || name.starts_with("build");
}

}  // namespace

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (fs::recursive_directory_iterator it(root), end; it != end; ++it) {
    if (it->is_directory() && is_foreign(it->path())) it.disable_recursion_pending();
    const bool is_page = it->path().extension() == ".md";
    const bool is_held = name_of(it->path()).starts_with("docs/") || it->path().parent_path() == root;
    if (is_page && (is_held || it->path().filename() == "README.md")) found.push_back(it->path());
  }
  std::ranges::sort(found);
  return found;
}

std::vector<PageLine> lines_of(const fs::path& page) {
  std::vector<PageLine> lines;
  std::ifstream in(page);
  std::string fence, before;
  bool indented = false;
  for (std::string text; std::getline(in, text);) {
    const bool is_fence = text.starts_with("```");
    if (is_fence) fence = fence.empty() ? text : "";
    indented = text.starts_with("    ") && (indented || before.empty() || !fence.empty());
    lines.push_back({text, static_cast<int>(lines.size()) + 1, indented || is_fence || !fence.empty(),
                     !is_fence && fence == "```sh"});
    before = text;
  }
  return lines;
}

std::string name_of(const fs::path& page) { return page.lexically_relative(root).string(); }

}  // namespace vitrail::test
