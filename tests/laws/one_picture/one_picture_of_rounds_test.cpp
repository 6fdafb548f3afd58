// SPDX-License-Identifier: Apache-2.0
// Where the film decides which samples come next, one picture still: whatever the domains, ranks, threads and
// memory, and however often the job is stopped and goes on with others.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "film/film_progress.h"
#include "tests/support/background.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"
#include "tests/support/paths.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::one_picture_of_rounds_test {
namespace {

using namespace std::chrono_literals;

class OnePictureOfRounds : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    directory_ = std::make_unique<TemporaryDirectory>();
    for (const int domains : {1, 8}) {
      const CommandResult made =
          run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains {} --quiet",
                          vitrail("partition"), source_dir(), bundle(domains), domains));
      ASSERT_EQ(made.status, 0) << made.output;
    }
  }
  static void TearDownTestSuite() { directory_.reset(); }
  static std::string bundle(int domains) { return (*directory_ / fmt::format("{}.vit", domains)).string(); }
  static std::filesystem::path file(const std::string& name) { return *directory_ / name; }

  static std::string command(const std::string& film, int domains, int ranks, const std::string& more) {
    return fmt::format("{} '{}' -o '{}' --width 40 --stats '{}' {}", vitrail_on(ranks, "render"),
                       bundle(domains), file(film).string(), file(film + ".json").string(), more);
  }
  static nlohmann::json stats(const std::string& film) { return read_json(file(film + ".json")); }

  // Without VITRAIL_LONG_TESTS only where `always` on all ranks, else alone and on three.
  static void expect_one_film(const std::string& goal, bool always = false) {
    std::string hash;
    int rounds = 0;
    struct Manner {
      int domains, ranks;
      const char* options;
    };
    for (const Manner& m : {Manner{1, 1, "--threads 1"}, Manner{8, 1, "--threads 2"},
                            Manner{8, 2, "--threads 2 --domain-memory 1"},
                            Manner{8, 3, "--threads 1 --domain-memory 1 --shuffle-delivery 5"}}) {
      if (!always && !are_long() && m.domains == 8 && m.ranks < 3) continue;
      const CommandResult done =
          run(command("a.film", m.domains, m.ranks, fmt::format("--force --quiet {} {}", goal, m.options)));
      ASSERT_EQ(done.status, 0) << done.output;
      const nlohmann::json s = stats("a.film");
      if (hash.empty()) hash = s["film_hash"], rounds = s["rounds"];
      EXPECT_EQ(s["film_hash"], hash) << m.domains << " domains, " << m.ranks << " ranks, " << m.options;
      EXPECT_EQ(s["rounds"], rounds);
    }
    EXPECT_GE(rounds, 2) << "nothing was decided";
    // Killed again and again, each time at its first checkpoint or soon after, on other ranks each time.
    const auto partial = file("b.film.partial");
    int kills = 0;
    for (int tries = 0; tries < 4; ++tries) {
      std::error_code none;
      const auto before = std::filesystem::last_write_time(partial, none);
      Background job(
          command("b.film", 8, 1 + tries % 2, goal + " --quiet --threads 1 --checkpoint-every 0.02"));
      while (job.running() && std::filesystem::last_write_time(partial, none) == before)
        std::this_thread::sleep_for(2ms);
      std::this_thread::sleep_for(tries * 20ms);
      if (job.running()) ++kills;
      for (const pid_t pid : tries % 2 == 0 ? std::vector{job.pid()} : job.ranks()) ::kill(pid, SIGKILL);
      job.wait();
    }
    const CommandResult done = run(command("b.film", 8, 1, goal));
    ASSERT_EQ(done.status, 0) << done.output;
    EXPECT_EQ(stats("b.film")["film_hash"], hash);
    EXPECT_GE(kills, 2) << "it never went on with anything";
    EXPECT_FALSE(std::filesystem::exists(file("b.film.partial")));
    std::filesystem::remove(file("b.film"));
  }

  static std::unique_ptr<TemporaryDirectory> directory_;
};

std::unique_ptr<TemporaryDirectory> OnePictureOfRounds::directory_;

TEST_F(OnePictureOfRounds, AdaptiveSamples) { expect_one_film("--spp 128 --adaptive", true); }

TEST_F(OnePictureOfRounds, UntilAnErrorIsReached) { expect_one_film("--target-error 0.12"); }

TEST_F(OnePictureOfRounds, AdaptiveUntilAnErrorIsReached) {
  expect_one_film("--target-error 3jnd --adaptive");
}

// Rounds leave no trace in a film of so many samples.
TEST_F(OnePictureOfRounds, UniformRoundsAreSamplesAsOthers) {
  ASSERT_EQ(run(command("a.film", 1, 1, "--force --target-error 0.12")).status, 0);
  const std::uint64_t samples = stats("a.film")["samples"];
  ASSERT_EQ(samples % (40 * 40), 0u);
  ASSERT_EQ(run(command("c.film", 8, 2, fmt::format("--force --spp {}", samples / (40 * 40)))).status, 0);
  EXPECT_EQ(stats("a.film")["film_hash"], stats("c.film")["film_hash"]);
  FilmProgress one, other;
  read_film(file("a.film"), &one), read_film(file("c.film"), &other);
  EXPECT_EQ(one.items, other.items);
  EXPECT_EQ(one.done, other.done);
}

TEST_F(OnePictureOfRounds, GoOnFromWhatIsThere) {
  ASSERT_EQ(run(command("d.film", 1, 1, "--force --spp 32 --adaptive")).status, 0);
  const CommandResult uniform = run(command("d.film", 1, 1, "--spp 64"));
  EXPECT_EQ(uniform.status, 3);
  EXPECT_THAT(uniform.output, ::testing::HasSubstr("--adaptive continues it"));
  const CommandResult finished = run(command("d.film", 1, 1, "--spp 32 --adaptive"));
  EXPECT_THAT(finished.output, ::testing::HasSubstr("finished already"));
  const CommandResult more = run(command("d.film", 8, 2, "--spp 64 --adaptive --progress lines"));
  EXPECT_THAT(more.output, ::testing::HasSubstr("going on from"));
  EXPECT_NEAR(stats("d.film")["samples"].get<double>() / (40 * 40), 64, 0.5);
  ASSERT_EQ(run(command("d.film", 1, 1, "--force --target-error 0.5")).status, 0);
  const double before = stats("d.film")["samples"];
  ASSERT_EQ(run(command("d.film", 1, 1, "--target-error 0.12")).status, 0);
  EXPECT_GT(stats("d.film")["samples"].get<double>(), before);
  EXPECT_TRUE(stats("d.film")["target_reached"].get<bool>());
}

TEST_F(OnePictureOfRounds, WhatIsNotReachedIsSaid) {
  const CommandResult short_of = run(command("e.film", 1, 1, "--force --target-error 0.0001 --spp 8"));
  EXPECT_EQ(short_of.status, 0);
  EXPECT_THAT(short_of.output, ::testing::HasSubstr("the error is not reached with 8 samples a pixel"));
  EXPECT_FALSE(stats("e.film")["target_reached"].get<bool>());
  for (const char* wrong : {"0", "-1", "1jnds", "x", "0.1 --spp 2"})
    EXPECT_EQ(run(command("e.film", 1, 1, fmt::format("--force --target-error {}", wrong))).status, 2)
        << wrong;
}

}  // namespace
}  // namespace vitrail::test::one_picture_of_rounds_test
