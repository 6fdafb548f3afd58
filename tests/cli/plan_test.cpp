// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::plan_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Plan : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(make("box.vit", 8), 0);
    ASSERT_EQ(render("box.json", "", 1).status, 0);
  }
  int make(const std::string& bundle, int domains, const std::string& options = "") const {
    return run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains {} {}",
                           vitrail("partition"), source_dir(), path(bundle), domains, options))
        .status;
  }
  CommandResult render(const std::string& profile, const std::string& options, int ranks) const {
    return run(
        fmt::format("{} '{}' -o '{}' --force --quiet --spp 4 --crop 0,64,0,64 --threads 1 --stats '{}' "
                    "--profile '{}' {}",
                    ranks > 1 ? mpi_vitrail("render", ranks) : vitrail("render"), path("box.vit"),
                    path("a.film"), path("stats.json"), path(profile), options));
  }
  CommandResult plan(const std::string& bundle, const std::string& options) const {
    return run(
        fmt::format("{} '{}' --profile '{}' {}", vitrail("plan"), path(bundle), path("box.json"), options));
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  TemporaryDirectory directory_;
};

// Every ray that is traced in a domain came from somewhere: on one rank with everything in memory, and on two
// with little.
TEST_F(Plan, ProfilesCountEveryRayOnItsWay) {
  ASSERT_EQ(render("two.json", "--domain-memory 1", 2).status, 0);
  for (const char* name : {"box.json", "two.json"}) {
    const nlohmann::json profile = read_json(path(name));
    std::map<int, std::uint64_t> arrived;
    std::uint64_t entered = 0;
    for (const auto& way : profile["ways"]) {
      arrived[way[1].get<int>()] += way[2].get<std::uint64_t>();
      if (way[0] == -1) entered += way[2].get<std::uint64_t>();
    }
    for (std::size_t d = 0; d < profile["domains"].size(); ++d)
      EXPECT_EQ(profile["domains"][d][0], arrived[static_cast<int>(d)]) << name << ' ' << d;
    EXPECT_EQ(profile["cost"]["camera_rays"], 64 * 64 * 4);
    // Of tasks that take turns one in three is recorded, and stands for all.
    EXPECT_NEAR(static_cast<double>(entered), 64 * 64 * 4, .05 * 64 * 64 * 4) << name;
    EXPECT_GT(profile["cost"]["camera_s"], 0);
    EXPECT_GT(profile["cost"]["trace_s"], 0);
  }
}

TEST_F(Plan, WarnsOfFewSamples) {
  const CommandResult whole =
      run(fmt::format("{} '{}' -o '{}' --quiet --spp 1 --profile '{}'", vitrail("render"), path("box.vit"),
                      path("whole.film"), path("whole.json")));
  ASSERT_EQ(whole.status, 0) << whole.output;
  const auto planned = [&](const std::string& options) {
    return run(fmt::format("{} '{}' --profile '{}' --ranks 1 {}", vitrail("plan"), path("box.vit"),
                           path("whole.json"), options));
  };
  EXPECT_THAT(
      planned("").output,
      HasSubstr("this plans as many samples as the profile has, 1 a pixel; --times 256 plans 256 times"));
  EXPECT_THAT(planned("--times 256").output, Not(HasSubstr("as the profile has")));
}

// One rank takes what was recorded, more take their share, and the picture is drawn.
TEST_F(Plan, SharesTheRecordedWork) {
  const CommandResult planned =
      plan("box.vit", fmt::format("--threads 1 --ranks 1,2 --times 50 --json --svg '{}'", path("plan.svg")));
  ASSERT_EQ(planned.status, 0) << planned.output;
  const nlohmann::json points = nlohmann::json::parse(planned.output)["plan"];
  ASSERT_EQ(points.size(), 2u);
  const double recorded = 50 * read_json(path("box.json"))["cost"]["trace_s"].get<double>();
  EXPECT_NEAR(points[0]["seconds"].get<double>(), recorded, .1 * recorded);
  EXPECT_NEAR(points[1]["seconds"].get<double>(), recorded / 2, .1 * recorded);
  EXPECT_GT(points[0]["efficiency"].get<double>(), .9);
  EXPECT_EQ(points[0]["limit"], "work");
  std::ifstream svg(path("plan.svg"));
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(svg), {}), HasSubstr("</svg>"));
  const nlohmann::json short_job = nlohmann::json::parse(
      plan("box.vit",
           "--threads 64 --ranks 64 --times 50 --slow-rank 2 --files-a-second 1e6 --ranks-a-link 4 --network "
           "100M --json")
          .output)["plan"][0];
  EXPECT_EQ(short_job["limit"], "beginning and end") << short_job.dump();
  const CommandResult table = plan("box.vit", "--threads 1 --ranks 1,4");
  EXPECT_EQ(table.status, 0);
  EXPECT_THAT(table.output, HasSubstr("limited by"));
}

// However many samples: as much is simulated as is needed.
TEST_F(Plan, ReckonsTenMillionPictures) {
  const auto seconds = [&](const char* times) {
    const CommandResult planned =
        plan("box.vit",
             fmt::format("--threads 1 --ranks 100 --distribution decompose --homes '{}' --json --times {}",
                         path("box.json"), times));
    EXPECT_EQ(planned.status, 0) << planned.output;
    return nlohmann::json::parse(planned.output)["plan"][0]["seconds"].get<double>();
  };
  EXPECT_NEAR(seconds("1e7") / seconds("1e6"), 10, .1);
}

// Eight domains in one pack: a server that takes 10 s to open a file is asked once, not eight times.
TEST_F(Plan, OpensAPackOnce) {
  ASSERT_EQ(make("packed.vit", 8, "--pack 1G"), 0);
  const auto seconds = [&](const char* bundle) {
    const CommandResult planned = plan(bundle, "--threads 1 --ranks 1 --times 50 --files-a-second .1 --json");
    EXPECT_EQ(planned.status, 0) << planned.output;
    return nlohmann::json::parse(planned.output)["plan"][0]["seconds"].get<double>();
  };
  EXPECT_NEAR(seconds("box.vit"), 80, 8);
  EXPECT_NEAR(seconds("packed.vit"), 10, 4);
}

TEST_F(Plan, RefusesTheProfileOfAnotherBundle) {
  ASSERT_EQ(make("other.vit", 4), 0);
  const CommandResult planned = plan("other.vit", "");
  EXPECT_EQ(planned.status, 3);
  EXPECT_THAT(planned.output, HasSubstr("other domains"));
  EXPECT_EQ(plan("box.vit", "--ranks 0").status, 2);
  EXPECT_EQ(plan("box.vit", "--memory 1M").status, 4);
}

}  // namespace
}  // namespace vitrail::test::plan_test
