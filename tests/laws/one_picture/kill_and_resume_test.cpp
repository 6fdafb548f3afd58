// SPDX-License-Identifier: Apache-2.0
// A run that is killed loses at most what came after its last checkpoint, and ends in the same film.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "tests/support/background.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::kill_and_resume_test {
namespace {

using namespace std::chrono_literals;

class KillAndResume : public ::testing::Test {
 protected:
  void SetUp() override {
    bundle_ = directory_ / "box.vit";
    const CommandResult made =
        run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains 8",
                        vitrail("partition"), source_dir(), bundle_.string()));
    ASSERT_EQ(made.status, 0) << made.output;
  }
  static constexpr int usual_spp = 80;  // a second of work for each of two ranks
  std::string command(const std::string& film, const std::string& more, int spp = usual_spp) const {
    return fmt::format("{} '{}' -o '{}' --crop 0,128,0,128 --spp {} --threads 1 --stats '{}' {}",
                       mpi_vitrail("render", 2), bundle_.string(), (directory_ / film).string(), spp,
                       (directory_ / (film + ".json")).string(), more);
  }
  // Until each rank has worked for longer than it takes to begin, however busy the machine is.
  static void wait_for_work(Background& job) {
    const auto has_worked = [](pid_t pid) {
      clockid_t clock;
      timespec time{};
      return ::clock_getcpuclockid(pid, &clock) == 0 && ::clock_gettime(clock, &time) == 0 &&
             static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec) > 0.3;
    };
    while (job.running()) {
      const std::vector<pid_t> ranks = job.ranks().empty() ? std::vector{job.pid()} : job.ranks();
      if (std::ranges::all_of(ranks, has_worked)) return;
      std::this_thread::sleep_for(10ms);
    }
  }
  nlohmann::json stats(const std::string& film) const { return read_json(directory_ / (film + ".json")); }
  // Of the usual film that nothing happened to, rendered once for all tests.
  nlohmann::json whole_hash() const {
    static nlohmann::json known;
    if (known.is_null() && run(command("whole.film", "")).status == 0)
      known = stats("whole.film")["film_hash"];
    EXPECT_FALSE(known.is_null());
    return known;
  }

  TemporaryDirectory directory_;
  std::filesystem::path bundle_;
};

TEST_F(KillAndResume, KilledRanksLeaveTheSameFilm) {
  constexpr int spp = 192;  // so that a rank is killed while it works, more often than while it begins
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(run(command("whole.film", "", spp)).status, 0);
  auto whole = std::chrono::steady_clock::now() - start;

  std::mt19937 random(20260711);
  const auto partial = directory_ / "killed.film.partial";
  int killed = 0;
  const int kills = of_all(5, 3);
  for (int tries = 0; killed < kills; ++tries) {
    ASSERT_LT(tries, 40);
    Background job(command("killed.film", "--checkpoint-every 0.1 --resume", spp));
    const auto moment = whole * std::uniform_real_distribution(0.06, 0.2)(random);
    std::this_thread::sleep_for(std::chrono::duration_cast<std::chrono::milliseconds>(moment));
    const std::vector<pid_t> ranks = job.ranks();
    if (!ranks.empty()) ::kill(ranks[random() % ranks.size()], SIGKILL);
    if (job.wait() == 0) {  // it ended first: this machine's speed is not what it was
      whole = whole * 3 / 4;
      killed = 0;
      std::filesystem::remove(directory_ / "killed.film");
      continue;
    }
    ++killed;
    EXPECT_FALSE(std::filesystem::exists(directory_ / "killed.film"));
  }
  ASSERT_TRUE(std::filesystem::exists(partial));
  const CommandResult finished = run(command("killed.film", "--resume", spp));
  ASSERT_EQ(finished.status, 0) << finished.output;
  EXPECT_EQ(stats("killed.film")["film_hash"], stats("whole.film")["film_hash"]);
  EXPECT_EQ(stats("killed.film")["samples"], 128 * 128 * spp);
  EXPECT_FALSE(std::filesystem::exists(partial));
}

TEST_F(KillAndResume, ARankThatHangsIsNamedAndTheJobGoesOn) {
  const auto script = directory_ / "job.sh", errors = directory_ / "errors";
  std::ofstream(script) << fmt::format(
      "exec env {} 2>'{}'", command("hung.film", "--checkpoint-every 0.1 --patience 3"), errors.string());
  Background job(fmt::format("sh '{}'", script.string()));
  while (job.running() &&
         (job.ranks().size() < 2 || !std::filesystem::exists(directory_ / "hung.film.partial")))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const std::vector<pid_t> ranks = job.ranks();
  ASSERT_EQ(ranks.size(), 2u);
  ::kill(ranks[1], SIGSTOP);
  EXPECT_EQ(job.wait(), 4);
  std::ifstream said(errors);
  const std::string text{std::istreambuf_iterator(said), {}};
  EXPECT_THAT(text, testing::ContainsRegex(
                        "rank 1 \\(.*, process [0-9]+\\) has not answered for 3 s .*it is stopped"));
  const CommandResult finished = run(command("hung.film", ""));
  ASSERT_EQ(finished.status, 0) << finished.output;
  EXPECT_EQ(stats("hung.film")["samples"], 128 * 128 * usual_spp);
}

// As long as it takes something: here half a second of work at a time.
TEST_F(KillAndResume, ADiskMayTakeLongerThanRanksHavePatience) {
  const std::string slow = fmt::format("LD_PRELOAD='{}' ", VITRAIL_SLOW_DISK);
  const CommandResult written = run(slow + command("slow.film", "--patience 2"));
  EXPECT_EQ(written.status, 0) << written.output;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "slow.film"));
}

TEST_F(KillAndResume, TermWritesACheckpointAndEndsByItself) {
  for (const bool alone : {true, false}) {
    std::string line = command("stopped.film", "");
    if (alone) line = line.substr(line.find(" '" + bin_dir()) + 1);
    Background job(line);
    wait_for_work(job);
    ASSERT_TRUE(job.running());
    for (pid_t pid : alone ? std::vector{job.pid()} : job.ranks()) ::kill(pid, SIGTERM);
    EXPECT_EQ(job.wait(), 128 + SIGTERM);
    EXPECT_TRUE(std::filesystem::exists(directory_ / "stopped.film.partial"));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "stopped.film"));
    ASSERT_EQ(run(command("stopped.film", "--resume")).status, 0);
    EXPECT_EQ(stats("stopped.film")["film_hash"], whole_hash());
    std::filesystem::remove(directory_ / "stopped.film");
  }
}

// Which counts the rays of all the picture, or there is none.
TEST_F(KillAndResume, AResumedRunHasNoProfile) {
  const auto profile = directory_ / "profile.json";
  const std::string options = fmt::format("--resume --profile '{}'", profile.string());
  const std::string line = command("stopped.film", options);
  Background job(line);
  wait_for_work(job);
  ASSERT_TRUE(job.running());
  for (const pid_t pid : job.ranks()) ::kill(pid, SIGTERM);
  EXPECT_EQ(job.wait(), 128 + SIGTERM);
  ASSERT_TRUE(std::filesystem::exists(directory_ / "stopped.film.partial"));
  EXPECT_FALSE(std::filesystem::exists(profile));
  const CommandResult resumed = run(line);
  EXPECT_EQ(resumed.status, 0);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "stopped.film"));
  EXPECT_THAT(resumed.output, ::testing::HasSubstr("profile.json is not written"));
  EXPECT_FALSE(std::filesystem::exists(profile));
  EXPECT_EQ(run(command("whole.film", options + " --max-depth 0")).status, 0);  // has nothing to resume
  EXPECT_TRUE(std::filesystem::exists(profile));
}

TEST_F(KillAndResume, RefusesAnotherJobsCheckpoint) {
  Background job(command("other.film", "--checkpoint-every 0.1"));
  while (job.running() && !std::filesystem::exists(directory_ / "other.film.partial"))
    std::this_thread::sleep_for(10ms);
  for (pid_t pid : job.ranks()) ::kill(pid, SIGKILL);
  job.wait();
  ASSERT_TRUE(std::filesystem::exists(directory_ / "other.film.partial"));
  for (const char* change : {"--seed 7", "--max-depth 2", "--integrator direct"}) {
    const CommandResult refused = run(command("other.film", std::string("--resume ") + change));
    EXPECT_EQ(refused.status, 3) << change << refused.output;
    EXPECT_THAT(refused.output, ::testing::HasSubstr("cannot be resumed")) << change;
  }
}

}  // namespace
}  // namespace vitrail::test::kill_and_resume_test
