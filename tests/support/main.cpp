// SPDX-License-Identifier: Apache-2.0
// The tests of one folder are one program. Called by a link test_NAME, the program runs those of NAME's
// files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vitrail::test {
namespace {

struct TestFile {
  std::string_view program, file;  // file: below the project's folder
};
// From vitrail_test's of this folder.
constexpr TestFile test_files[] = {
#include "test_files.h"
};

std::vector<std::string_view> files_of(std::string_view program) {
  std::vector<std::string_view> files;
  for (const TestFile& f : test_files)
    if (f.program == program) files.push_back(f.file);
  return files;
}

bool is_in(const testing::TestInfo& test, const std::vector<std::string_view>& files) {
  const std::string_view file = test.file();
  for (const std::string_view f : files)
    if (file.ends_with(f)) return true;
  return false;
}

// Adds to --gtest_filter that tests of other files do not run. Returns how many are left.
int leave_out_other_files(const std::vector<std::string_view>& files) {
  std::string filter = GTEST_FLAG_GET(filter);
  char separator = filter.find('-') == std::string::npos ? '-' : ':';
  int left = 0;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int i = 0; i < suite.total_test_count(); ++i) {
      const testing::TestInfo& test = *suite.GetTestInfo(i);
      if (is_in(test, files)) {
        ++left;
        continue;
      }
      filter += separator + std::string(suite.name()) + "." + test.name();
      separator = ':';
    }
  }
  GTEST_FLAG_SET(filter, filter);
  return left;
}

int run_tests(int count, char** arguments) {
  const std::string program = std::filesystem::path(arguments[0]).filename().string();
  testing::InitGoogleMock(&count, arguments);
  const std::vector<std::string_view> files = files_of(program);
  if (!files.empty() && leave_out_other_files(files) == 0) {
    std::fprintf(stderr, "%s: no test is in its files\n", program.c_str());
    return 1;
  }
  return RUN_ALL_TESTS();
}

}  // namespace
}  // namespace vitrail::test

int main(int count, char** arguments) { return vitrail::test::run_tests(count, arguments); }
