// SPDX-License-Identifier: Apache-2.0
// The tests of one folder are one program. Called by a link test_NAME, the program runs those of NAME's
// files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/paths.h"
#include "tests/support/test_files.h"

namespace vitrail::test {
namespace {

std::vector<std::string_view> files_of(std::string_view program) {
  std::vector<std::string_view> files;
  for (const TestFile& f : test_files)
    if (f.program == program) files.push_back(f.file);
  return files;
}

enum class Share { none, part, all };
Share share_of(const testing::TestSuite& suite, const std::vector<std::string_view>& files) {
  int inside = 0;
  for (int i = 0; i < suite.total_test_count(); ++i) {
    const std::string_view file = suite.GetTestInfo(i)->file();
    for (const std::string_view f : files) inside += file.ends_with(f);
  }
  return inside == 0 ? Share::none : inside < suite.total_test_count() ? Share::part : Share::all;
}

// Narrows --gtest_filter to the suites of these files; false, with a message, where that cannot be done.
bool choose_suites(const std::vector<std::string_view>& files) {
  std::string own, others;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    const Share share = share_of(suite, files);
    if (share == Share::part) {
      std::fprintf(stderr, "%s has tests in files of several programs\n", suite.name());
      return false;
    }
    std::string& list = share == Share::all ? own : others;
    list += (list.empty() ? "" : ":") + std::string(suite.name()) + ".*";
  }
  if (own.empty()) std::fprintf(stderr, "none of the files has tests\n");
  const std::string asked = GTEST_FLAG_GET(filter);
  const char* separator = others.empty() ? "" : asked.find('-') == std::string::npos ? "-" : ":";
  GTEST_FLAG_SET(filter, asked == "*" ? own : asked + separator + others);
  return !own.empty();
}

// Puts the folder of programs that wait less than usual, of which there may be none, before the others.
void find_hurried_programs() {
  const char* path = std::getenv("PATH");
  setenv("PATH", (bin_dir() + "/../hurried:" + (path ? path : "")).c_str(), 1);
}

int run_tests(int count, char** arguments) {
  const std::string program = std::filesystem::path(arguments[0]).filename().string();
  testing::InitGoogleMock(&count, arguments);
  find_hurried_programs();
  const std::vector<std::string_view> files = files_of(program);
  if (files.empty() && !test_files.empty() && !program.starts_with("test_in_")) {
    std::fprintf(stderr, "%s: no tests are called so; is the program built?\n", program.c_str());
    return 1;
  }
  if (!files.empty() && !choose_suites(files)) return 1;
  return RUN_ALL_TESTS();
}

}  // namespace
}  // namespace vitrail::test

int main(int count, char** arguments) { return vitrail::test::run_tests(count, arguments); }
