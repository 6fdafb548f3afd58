// SPDX-License-Identifier: Apache-2.0
// Streams and disks that take nothing: no work is lost for it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "film/film.h"
#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {
namespace {

using ::testing::HasSubstr;

class FailingMachine : public ::testing::Test {
 protected:
  void SetUp() override {
    const CommandResult made =
        run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains 2 --quiet",
                        vitrail("partition"), VITRAIL_SOURCE_DIR, path("box.vit")));
    ASSERT_EQ(made.status, 0) << made.output;
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string arguments(const std::string& out, const std::string& more) const {
    return fmt::format("'{}' -o '{}' --crop 0,32,0,32 --spp 4 --threads 1 {}", path("box.vit"), out, more);
  }
  std::string line(const std::string& out, const std::string& more) const {
    return vitrail("render ") + arguments(path(out), more);
  }

  TemporaryDirectory directory_;
};

TEST_F(FailingMachine, FullOrClosedStreamsLoseNothing) {
  ASSERT_EQ(run(line("a.film", "")).status, 0);
  const std::uint64_t hash = read_film(path("a.film"), nullptr).hash();
  int number = 0;
  for (const char* streams :
       {"--progress bar 2>/dev/full", "--progress lines 2>&-", "--progress json >/dev/full",
        "--progress json >&- 2>&- <&-", "--progress json 2>/dev/full | true"}) {
    const std::string out = fmt::format("{}.film", ++number);
    // A shell of its own: what `run` adds is not its streams'.
    const CommandResult made = run(fmt::format("sh -c \"{}\"", line(out, streams)));
    EXPECT_EQ(made.status, 0) << streams << made.output;
    ASSERT_TRUE(std::filesystem::exists(path(out))) << streams;
    EXPECT_EQ(read_film(path(out), nullptr).hash(), hash) << streams;
  }
}

TEST_F(FailingMachine, AFullStreamDoesNotChangeTheStatus) {
  EXPECT_EQ(run(fmt::format("sh -c \"{}\"", vitrail("render ") + "no-such.vit 2>/dev/full")).status, 3);
  EXPECT_EQ(
      run(fmt::format("sh -c \"{}\"", vitrail("partition ") + "no-such.pbrt -o x.vit 2>/dev/full")).status,
      3);
}

}  // namespace
}  // namespace vitrail::test
