// SPDX-License-Identifier: Apache-2.0
// When homes settle, on which, and what a rank then keeps in memory.
#include "farm/run/settling.h"

#include <gtest/gtest.h>

#include <limits>

#include "farm/scheduler/homes.h"
#include "farm/scheduler/residency.h"

namespace vitrail::settling_test {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

// A second of a job of `samples_a_second`, of which `left` are left.
struct Job {
  explicit Job(bool may_settle) : settling(plan_of(may_settle), {}) {}
  static JobPlan plan_of(bool may_settle) {
    JobPlan plan;
    plan.may_settle = may_settle;
    return plan;
  }
  void second(std::int64_t samples, double left, double until_limit_s = no_limit, std::int64_t items = 10) {
    sums.samples += samples;
    sums.items_done += items;
    sums.rays_traced += rays;
    settling.watch(sums, {++now_s, left, until_limit_s, 20});
  }
  Settling settling;
  RoundSums sums;
  std::int64_t rays = 1 << 21;  // a second
  double now_s = 0;
};

TEST(Settling, ALongJobRecordsAndThenPausesOnce) {
  Job job(true);
  job.second(100, 100'000);
  EXPECT_FALSE(job.settling.profiles()) << "it loads yet";
  job.second(100, 100'000);
  EXPECT_TRUE(job.settling.profiles());
  for (int s = 0; s < 4; ++s) job.second(100, 100'000);
  EXPECT_FALSE(job.settling.settles(job.now_s));
  job.second(100, 100'000);
  EXPECT_EQ(job.settling.settles(job.now_s), 1);
  EXPECT_EQ(job.settling.settles(job.now_s + 5), 2) << "rays that take longer go to the new homes";
  EXPECT_TRUE(job.settling.profiles()) << "until homes have settled";
  job.settling.is_over();
  for (int s = 0; s < 100; ++s) job.second(100, 100'000);
  EXPECT_FALSE(job.settling.settles(job.now_s) || job.settling.profiles());
}

TEST(Settling, AJobThatEndsSoonNeverPauses) {
  for (const auto& [left, limit] : {std::pair{2'000., no_limit}, {100'000., 30.}}) {
    Job job(true);
    for (int s = 0; s < 20; ++s) {
      job.second(100, left, limit);
      EXPECT_FALSE(job.settling.profiles()) << left;
    }
  }
  Job other(false);
  for (int s = 0; s < 20; ++s) other.second(100, 100'000);
  EXPECT_FALSE(other.settling.profiles());
  // It was slow at first.
  Job job(true);
  for (int s = 0; s < 3; ++s) job.second(10, 3'000);
  EXPECT_TRUE(job.settling.profiles());
  for (int s = 0; s < 7; ++s) {
    job.second(300, 3'000);
    EXPECT_FALSE(job.settling.settles(job.now_s));
  }
  EXPECT_FALSE(job.settling.profiles());
}

// The sky is seen at once; what is behind the first bounces takes its time.
TEST(Settling, AJobThatTurnsOutToBeLongRecords) {
  Job job(true);
  for (int s = 0; s < 5; ++s) job.second(1'000, 20'000);
  EXPECT_FALSE(job.settling.profiles()) << "20 s are left";
  for (int s = 0; s < 20; ++s) job.second(10, 20'000);
  EXPECT_TRUE(job.settling.profiles());
}

// Millions of rays are born at once; that they wait is no progress.
TEST(Settling, RaysThatWaitAreNotDone) {
  Job job(true);
  job.sums.born = 10'000, job.sums.died = 100;
  job.second(1'000, 1'000), job.second(0, 1'000);
  EXPECT_TRUE(job.settling.profiles()) << "200 s are left, not 2";
}

TEST(Settling, AProfileIsOfAWholePass) {
  Job job(true);
  for (int s = 0; s < 20; ++s) job.second(100, 100'000, no_limit, 1);
  EXPECT_FALSE(job.settling.settles(job.now_s));
  job.second(100, 100'000, no_limit, 2);
  EXPECT_TRUE(job.settling.settles(job.now_s));
}

TEST(Settling, AProfileNeedsRays) {
  Job job(true);
  job.rays = 10'000;
  for (int s = 0; s < 20; ++s) job.second(100, 100'000);
  EXPECT_FALSE(job.settling.settles(job.now_s)) << "others use the machine";
  job.rays = 1 << 21;
  job.second(100, 100'000);
  EXPECT_TRUE(job.settling.settles(job.now_s));
}

Manifest of_domains(std::size_t count, std::uint64_t bytes) {
  Manifest m;
  m.domains.resize(count);
  for (DomainInfo& d : m.domains) d.bytes = bytes;
  return m;
}

RayProfile of_seconds(const Manifest& m, const std::vector<double>& seconds) {
  return RayProfile(m, std::vector<std::uint64_t>(seconds.size()), seconds, {}, {});
}

TEST(BetterHomes, AreOfEqualWorkWhereTheyFit) {
  const Manifest m = of_domains(8, 100);
  const RayProfile hot = of_seconds(m, {1, 1, 1, 1, 1, 1, 1, 21});
  const Homes now = homes_by_bytes(m, 4);
  EXPECT_NEAR(busiest_over_mean(now, hot), 22. * 4 / 28, 1e-6);
  const auto roomy = better_homes(m, hot, now, 1000);
  ASSERT_TRUE(roomy);
  EXPECT_NEAR(busiest_over_mean(*roomy, hot), 1, .01);
  EXPECT_GT(domains_moved(now, *roomy), 0u);
  EXPECT_GT(most_bytes_at_home(m, *roomy), 600u) << "so that the case below is one";
  // What fitted has to fit, else it would be read again and again.
  const auto tight = better_homes(m, hot, now, 600);
  ASSERT_TRUE(tight);
  EXPECT_LE(most_bytes_at_home(m, *tight), 600u);
  EXPECT_LT(busiest_over_mean(*tight, hot), .9 * busiest_over_mean(now, hot));
  EXPECT_FALSE(better_homes(m, hot, now, 200));
  EXPECT_TRUE(better_homes(m, hot, now, 100)) << "nothing fitted before";
  EXPECT_FALSE(better_homes(m, of_seconds(m, std::vector<double>(8, 1)), now, 1000)) << "all have as much";
  // One domain for all.
  const Manifest one = of_domains(1, 100);
  const auto copies = better_homes(one, of_seconds(one, {9}), homes_by_bytes(one, 4), 100);
  ASSERT_TRUE(copies);
  EXPECT_EQ(copies->places(), 4u);
}

// Rays that pass would be traced here as long as a domain is in memory.
TEST(Settling, WhatMovedOutLeavesTheMemory) {
  const Manifest m = of_domains(4, 100);
  Scheduler scheduler({2, 1, 1000, 0}, Residency(m, 250, Homes({0, 0, 1, 1}, 2), 0, Distribution::decompose));
  const Residency& residency = scheduler.residency();
  for (const std::uint32_t d : {0u, 1u}) {
    EXPECT_TRUE(scheduler.route(d, 5));
    ASSERT_TRUE(scheduler.loader_is_free().load);
    scheduler.loaded(d);
    scheduler.begin_batch(d, 5);
  }
  const LoadStep step = scheduler.settle(Homes({1, 0, 0, 1}, {1, 1, 0, 1}, 2), 250);
  EXPECT_EQ(step.evicted, std::vector<std::uint32_t>{0});
  EXPECT_FALSE(step.load);
  EXPECT_EQ(residency.evictions(), 1u);
  scheduler.released(100);
  EXPECT_EQ(residency.held_bytes(), 100u);
  EXPECT_FALSE(scheduler.route(0, 1));
  EXPECT_FALSE(scheduler.route(3, 1));
  EXPECT_TRUE(scheduler.route(1, 1));
  EXPECT_EQ(residency.fullest(), 1u) << "it stayed in memory";
  EXPECT_TRUE(scheduler.route(2, 7));
  const LoadStep next = scheduler.loader_is_free();
  ASSERT_TRUE(next.load);
  EXPECT_EQ(next.load->domain, 2u);
  EXPECT_TRUE(next.evicted.empty());
}

}  // namespace
}  // namespace vitrail::settling_test
