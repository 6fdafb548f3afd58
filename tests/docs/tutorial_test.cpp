// SPDX-License-Identifier: Apache-2.0
// Types what the tutorials say, with smaller pictures, line by line, in an empty folder beside examples/ and
// scripts/.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>

#include "tests/docs/pages.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::tutorial_test {
namespace {

namespace fs = std::filesystem;

// A line as it is typed where time is short: pictures, samples and triangles are a quarter, or a tenth, of
// what they are. With VITRAIL_LONG_TESTS as it stands.
std::string shortened(const std::string& line) {
  if (std::getenv("VITRAIL_LONG_TESTS")) return line;
  static const std::regex amount("--(width|height|spp|triangles) ([0-9]+)");
  std::string text, rest = line;
  for (std::smatch found; std::regex_search(rest, found, amount); rest = found.suffix()) {
    const int share = found[1] == "triangles" ? 10 : 4;
    text += fmt::format("{}--{} {}", found.prefix().str(), found[1].str(),
                        std::max(1, std::stoi(found[2]) / share));
  }
  return text + rest;
}

class Tutorial : public ::testing::TestWithParam<std::string> {};

TEST_P(Tutorial, CanBeTyped) {
  const TemporaryDirectory folder;
  for (const char* name : {"examples", "scripts"})
    fs::create_directory_symlink(fs::path(source_dir()) / name, folder / name);
  {
    std::ofstream script(folder / "typed.sh");
    script << "set -euo pipefail\nPATH=" + bin_dir() + ":/usr/bin:$PATH\n";
    for (const PageLine& line : lines_of(fmt::format("{}/docs/tutorial/{}.md", source_dir(), GetParam())))
      if (line.is_typed) script << shortened(line.text) << "\n";
  }
  const CommandResult typed = run(fmt::format("cd '{}' && bash -x typed.sh", folder.path().string()));
  EXPECT_EQ(typed.status, 0) << typed.output;
  EXPECT_NE(typed.output.find("+ vitrail "), std::string::npos);
}

std::vector<std::string> tutorials() {
  std::vector<std::string> names;
  for (const fs::path& page : pages())
    if (name_of(page).starts_with("docs/tutorial/")) names.push_back(page.stem());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Each, Tutorial, ::testing::ValuesIn(tutorials()), [](const auto& test) {
  std::string name = test.param;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace vitrail::test::tutorial_test
