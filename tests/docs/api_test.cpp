// SPDX-License-Identifier: Apache-2.0
// The C++ API is documented: Doxygen finds no function and no type without a comment in the headers of
// docs/api/Doxyfile.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::api_test {
namespace {

TEST(Api, HasNothingUndocumented) {
  if (run("doxygen --version").status != 0) GTEST_SKIP() << "there is no doxygen";
  const TemporaryDirectory directory;
  const CommandResult made = run(
      fmt::format("cd {} && (cat docs/api/Doxyfile; echo 'GENERATE_HTML = NO'; echo 'GENERATE_XML = YES'; "
                  "echo 'OUTPUT_DIRECTORY = {}') | doxygen -",
                  source_dir(), directory.path().string()));
  ASSERT_EQ(made.status, 0) << made.output;
  ASSERT_TRUE(std::filesystem::exists(directory / "xml" / "index.xml"));
  std::istringstream lines(made.output);
  int undocumented = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.find("is not documented") != line.npos &&
        (line.find("(function)") != line.npos || line.find("Compound vitrail::") != line.npos)) {
      ADD_FAILURE() << line;
      ++undocumented;
    }
  EXPECT_EQ(undocumented, 0);
}

}  // namespace
}  // namespace vitrail::test::api_test
