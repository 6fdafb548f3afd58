// SPDX-License-Identifier: Apache-2.0
// Where the documentation points to, something is; and its new pages are made for narrow windows.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "tests/docs/pages.h"
#include "tests/support/paths.h"

namespace vitrail::test::links_test {
namespace {

namespace fs = std::filesystem;

// As GitHub makes an anchor of a heading: small letters, spaces as hyphens, no other marks.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto u = static_cast<unsigned char>(c);
    if (c == ' ' || c == '-')
      anchor += '-';
    else if (u >= 0x80 || std::isalnum(u) || c == '_')
      anchor += static_cast<char>(std::tolower(u));
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  for (const PageLine& line : lines_of(page))
    if (!line.is_code && line.text.starts_with("#"))
      anchors.insert(anchor_of(line.text.substr(line.text.find_first_not_of("# "))));
  return anchors;
}

void expect_target(const fs::path& page, int line, const std::string& link) {
  const std::size_t hash = link.find('#');
  const fs::path target = hash == 0 ? page : (page.parent_path() / link.substr(0, hash)).lexically_normal();
  EXPECT_TRUE(fs::exists(target)) << name_of(page) << ":" << line << ": " << link;
  if (hash == std::string::npos || target.extension() != ".md") return;
  EXPECT_TRUE(anchors_of(target).contains(link.substr(hash + 1)))
      << name_of(page) << ":" << line << ": " << link;
}

TEST(Links, LeadSomewhere) {
  static const std::regex link(R"(\]\(([^)\s]+)\))");
  int count = 0;
  for (const fs::path& page : pages())
    for (const PageLine& line : lines_of(page)) {
      if (line.is_code) continue;
      for (std::sregex_iterator it(line.text.begin(), line.text.end(), link), end; it != end; ++it) {
        const std::string target = (*it)[1];
        if (target.find("://") != std::string::npos) continue;
        expect_target(page, line.number, target);
        ++count;
      }
    }
  EXPECT_GT(count, 200);
}

TEST(Links, LeadToEveryPageFromTheIndex) {
  const fs::path index = fs::path(source_dir()) / "docs/README.md";
  std::string text;
  for (const PageLine& line : lines_of(index)) text += line.text + "\n";
  for (const fs::path& page : pages())
    if (name_of(page).starts_with("docs/") && page != index) {
      EXPECT_NE(text.find("(" + page.lexically_relative(index.parent_path()).string() + ")"),
                std::string::npos)
          << name_of(page);
    }
}

// The page of the architecture has each folder of sources on two levels.
TEST(Architecture, NamesEveryFolder) {
  std::string page;
  for (const PageLine& line : lines_of(project_file("docs/reference/architecture.md")))
    page += line.text + "\n";
  int seen = 0;
  for (const char* module : {"scene", "glazing", "images", "importers", "bundle", "partitioner", "film",
                             "denoise", "tracer", "farm", "compare", "measure"}) {
    const std::size_t begin = page.find(std::string("**") + module + "/**");
    ASSERT_NE(begin, std::string::npos) << module;
    const std::string part = page.substr(begin, page.find("\n- **", begin) - begin);
    for (const auto& entry : fs::directory_iterator(project_file(module))) {
      if (!entry.is_directory()) continue;
      ++seen;
      const std::string name = entry.path().filename().string() + "/";
      EXPECT_NE(part.find(name), std::string::npos) << module << "/" << name;
    }
    // What it names is there.
    static const std::regex folder(R"(([a-z]+)/[ ,])");
    for (std::sregex_iterator at(part.begin(), part.end(), folder), end; at != end; ++at) {
      const std::string name = (*at)[1];
      if (name == "read" || name == "write") continue;  // within a format
      EXPECT_TRUE(fs::exists(project_file(module) + "/" + name)) << module << "/" << name;
    }
  }
  EXPECT_GT(seen, 40);
}

TEST(Lines, OfPagesForUsersAreShort) {
  for (const fs::path& page : pages()) {
    const std::string name = name_of(page);
    if (!name.starts_with("docs/tutorial") && !name.starts_with("docs/how-to") &&
        name != "docs/glossary.md" && name != "docs/README.md")
      continue;
    if (name == "docs/how-to/adding.md") continue;  // for developers, as wide as the code's comments may be
    for (const PageLine& line : lines_of(page)) {
      const auto columns = std::ranges::count_if(line.text, [](char c) { return (c & 0xC0) != 0x80; });
      EXPECT_TRUE(columns <= 120 || line.text.starts_with("|")) << name << ":" << line.number;
    }
  }
}

}  // namespace
}  // namespace vitrail::test::links_test
