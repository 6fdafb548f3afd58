// SPDX-License-Identifier: Apache-2.0
// The version stands in CMakeLists.txt. What cannot read it there has the same.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>

#include "tests/docs/pages.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"

namespace vitrail::test::version_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& name) {
  std::ifstream in(project_file(name));
  return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> numbers_in(const std::string& text, const std::regex& place) {
  std::set<std::string> numbers;
  for (std::sregex_iterator at(text.begin(), text.end(), place), end; at != end; ++at)
    numbers.insert((*at)[1]);
  return numbers;
}

TEST(Version, IsOne) {
  const std::string build = text_of("CMakeLists.txt");
  std::smatch stated;
  ASSERT_TRUE(std::regex_search(build, stated, std::regex(R"(project\(vitrail VERSION ([0-9.]+))")));
  const std::set<std::string> version{stated[1]};

  const std::string number = R"(([0-9]+\.[0-9]+\.[0-9]+))";
  EXPECT_EQ(numbers_in(run(vitrail("--version")).output, std::regex("vitrail " + number)), version);
  EXPECT_EQ(numbers_in(text_of("CITATION.cff"), std::regex("\nversion: " + number)), version);
  EXPECT_EQ(numbers_in(text_of("examples/cluster/spack/packages/vitrail/package.py"),
                       std::regex("version\\(\"" + number)),
            version);
  std::smatch newest;
  const std::string changes = text_of("CHANGELOG.md");
  ASSERT_TRUE(std::regex_search(changes, newest, std::regex("\n## " + number)));
  EXPECT_EQ(newest[1], stated[1]);
  // These read it.
  EXPECT_TRUE(numbers_in(text_of("pyproject.toml"), std::regex("\nversion *= *\"" + number)).empty());
  EXPECT_TRUE(numbers_in(text_of("cmake/debian/changelog.in"), std::regex("vitrail \\(" + number)).empty());
  // Names of files and of what Spack builds.
  const std::regex name("vitrail(?:-images)?[_@-]v?" + number);
  int seen = 0;
  for (const fs::path& page : pages()) {
    const std::set<std::string> numbers = numbers_in(text_of(name_of(page)), name);
    if (numbers.empty()) continue;
    ++seen;
    EXPECT_EQ(numbers, version) << name_of(page);
  }
  EXPECT_GT(seen, 2);
}

// CHANGELOG.md says which pictures the newest version makes.
TEST(Version, NamesTheRevisionOfItsPictures) {
  const std::set<std::string> revision =
      numbers_in(text_of("film/renderer_version.cpp"), std::regex("picture_revision = ([0-9]+)"));
  const std::string changes = text_of("CHANGELOG.md");
  const std::size_t first = changes.find("\n## "), second = changes.find("\n## ", first + 1);
  EXPECT_EQ(numbers_in(changes.substr(first, second - first), std::regex("Pictures of revision ([0-9]+)")),
            revision);
}

}  // namespace
}  // namespace vitrail::test::version_test
