// SPDX-License-Identifier: Apache-2.0
// Types what the tutorials say, line by line, in an empty folder beside examples/ and scripts/.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/docs/pages.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::tutorial_test {
namespace {

namespace fs = std::filesystem;

class Tutorial : public ::testing::TestWithParam<std::string> {};

TEST_P(Tutorial, CanBeTyped) {
  const TemporaryDirectory folder;
  for (const char* name : {"examples", "scripts"})
    fs::create_directory_symlink(fs::path(source_dir()) / name, folder / name);
  {
    std::ofstream script(folder / "typed.sh");
    script << "set -euo pipefail\nPATH=" + bin_dir() + ":/usr/bin:$PATH\n";
    for (const PageLine& line : lines_of(fmt::format("{}/docs/tutorial/{}.md", source_dir(), GetParam())))
      if (line.is_typed) script << line.text << "\n";
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
