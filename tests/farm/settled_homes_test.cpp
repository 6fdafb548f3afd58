// SPDX-License-Identifier: Apache-2.0
// A job that settles its homes by itself makes the film that it makes without.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::settled_homes_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SettledHomes : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    directory_ = std::make_unique<TemporaryDirectory>();
    partition("box.vit", 8);
  }
  static void TearDownTestSuite() { directory_.reset(); }
  static std::string path(const std::string& name) { return (*directory_ / name).string(); }

  static void partition(const std::string& bundle, int domains) {
    const CommandResult made =
        run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains {} --quiet",
                        vitrail("partition"), source_dir(), path(bundle), domains));
    ASSERT_EQ(made.status, 0) << made.output;
  }

  // On four ranks, each of which traces in its own domains.
  static CommandResult render(const std::string& film, const std::string& more,
                              const std::string& bundle = "box.vit") {
    return run(fmt::format("{} '{}' -o '{}' --width 64 --threads 1 --distribution decompose --stats '{}' {}",
                           vitrail_on(4, "render"), path(bundle), path(film), path(film + ".json"), more));
  }
  static nlohmann::json stats(const std::string& film) { return read_json(path(film + ".json")); }

  static std::unique_ptr<TemporaryDirectory> directory_;
};

std::unique_ptr<TemporaryDirectory> SettledHomes::directory_;

TEST_F(SettledHomes, MakeTheSameFilmAndTheNumbersAddUp) {
  const CommandResult bytes = render("bytes.film", "--spp 64 --homes bytes --settle-after 0");
  ASSERT_EQ(bytes.status, 0) << bytes.output;
  EXPECT_THAT(bytes.output, Not(HasSubstr("homes settled")));
  const CommandResult settled =
      render("settled.film",
             fmt::format("--spp 64 --settle-after 0 --settle-ending 60 --checkpoint-every 0.2 --trace '{}'",
                         path("trace.json")));
  ASSERT_EQ(settled.status, 0) << settled.output;
  EXPECT_THAT(settled.output, HasSubstr("vitrail: homes settled after"));
  const nlohmann::json stayed = stats("bytes.film"), moved = stats("settled.film");
  for (const char* key : {"film_hash", "samples", "rays_camera", "rays_indirect", "rays_shadow", "crossings",
                          "domains_touched", "rounds", "complete"})
    EXPECT_EQ(moved[key], stayed[key]) << key;
  EXPECT_EQ(stayed["domains_moved"], 0);
  EXPECT_EQ(stayed["settled_s"], 0);
  EXPECT_GT(moved["domains_moved"], 0);
  EXPECT_LE(moved["domains_moved"], 8);
  EXPECT_EQ(moved["settled_rays"], 0) << "none was alive";
  EXPECT_GT(moved["settled_s"], 0);
  EXPECT_LT(moved["settled_s"], moved["wall_s"]);
  EXPECT_GT(moved["settled_trace_s"], 0);
  EXPECT_LT(moved["settled_trace_s"], moved["trace_s"]);
  EXPECT_LE(moved["busiest_settled_trace_s"], moved["settled_trace_s"]);
  EXPECT_GE(4 * moved["busiest_settled_trace_s"].get<double>(), moved["settled_trace_s"].get<double>());
  double rays = 0;
  for (const auto& rank : moved["by_rank"]) rays += rank["rays"].get<double>();
  EXPECT_EQ(rays, moved["rays_camera"].get<double>() + moved["rays_indirect"].get<double>() +
                      moved["rays_shadow"].get<double>());
}

TEST_F(SettledHomes, GoWithRoundsLimitsProfilesAndResumedJobs) {
  const auto settles = [&](const std::string& film, const std::string& more) {
    const CommandResult done = render(film, "--settle-after 0 --settle-ending 60 " + more);
    EXPECT_EQ(done.status, 0) << done.output;
    EXPECT_THAT(done.output, HasSubstr("homes settled")) << more;
    return done.status == 0 ? stats(film) : nlohmann::json();
  };
  const std::string rounds = "--spp 64 --adaptive";
  ASSERT_EQ(render("r.film", rounds + " --homes bytes").status, 0);
  EXPECT_EQ(settles("s.film", rounds)["film_hash"], stats("r.film")["film_hash"]);

  ASSERT_EQ(render("whole.film", "--spp 512 --homes bytes").status, 0);
  const nlohmann::json limited = settles("part.film", "--spp 512 --time 2");
  EXPECT_FALSE(limited["complete"]) << "the case is none";
  ASSERT_EQ(settles("part.film", "--spp 512")["film_hash"], stats("whole.film")["film_hash"]);

  const std::string profile = fmt::format("--spp 64 --profile '{}'", path("rays.json"));
  settles("p.film", profile);
  const nlohmann::json rays = read_json(path("rays.json"));
  EXPECT_EQ(rays["cost"]["camera_rays"], stats("p.film")["rays_camera"]);
}

// One of four ranks has no domain, so homes move however little their record tells.
TEST_F(SettledHomes, TakeTheRaysThatWaitWithThem) {
  partition("few.vit", 3);
  const auto render_few = [](const std::string& film, const std::string& more) {
    const CommandResult done = render(film, "--spp 64 " + more, "few.vit");
    EXPECT_EQ(done.status, 0) << done.output;
    return stats(film);
  };
  const nlohmann::json stayed = render_few("stayed.film", "--homes bytes");
  std::uint64_t sent = 0;
  for (const double after_s : {0., 0.1, 0.3}) {
    const nlohmann::json moved =
        render_few("moved.film", fmt::format("--force --settle-after {} --settle-ending 0", after_s));
    EXPECT_EQ(moved["film_hash"], stayed["film_hash"]) << after_s;
    sent += moved["settled_rays"].get<std::uint64_t>();
  }
  EXPECT_GT(sent, 0u) << "the case is none";
}

TEST_F(SettledHomes, AreNotForShortJobs) {
  const CommandResult done = render("short.film", "--spp 64");
  ASSERT_EQ(done.status, 0) << done.output;
  EXPECT_THAT(done.output, Not(HasSubstr("homes settled")));
  EXPECT_EQ(stats("short.film")["domains_moved"], 0);
}

}  // namespace
}  // namespace vitrail::test::settled_homes_test
