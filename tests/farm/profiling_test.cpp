// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "farm/run/gather_profile.h"
#include "farm/run/profiling.h"

namespace vitrail::profiling_test {
namespace {

// Recording takes ten times as long: it counts in neither sum.
TEST(Profiling, TellsWhatTracingCostsWithoutIt) {
  using Manner = Profiling::Manner;
  using Work = Scheduler::Work;
  Profiling profiling(1);
  const auto take = [&](Work work, std::uint64_t rays, double recorded_s, double walking_s, double plain_s) {
    const Manner manner = profiling.next(work);
    const double seconds[] = {recorded_s, walking_s, plain_s};
    profiling.took(work, manner, rays, seconds[static_cast<std::size_t>(manner)]);
  };
  take(Work::generate, 100, 10, 2, 1);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::plain), 10) << "nothing else is known yet";
  for (int i = 0; i < 5; ++i) take(Work::generate, 100, 10, 2, 1);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::plain), 6);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::walking), 12);
  EXPECT_EQ(Profiling::samples_a_recorded_one(profiling.sums), 3);
  for (int i = 0; i < 6; ++i) take(Work::trace, 1000, 100, 30, 20);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::plain), 6 + 120);
  EXPECT_EQ(Profiling::seconds_of_all(profiling.sums, Manner::walking), 12 + 180);
  EXPECT_EQ(Profiling::samples_a_recorded_one(profiling.sums), 3) << "rays are not samples";
}

// Rays that a task sent where nobody recorded it were traced all the same where they arrived: none goes on
// from where none was.
TEST(Profiling, KnowsRaysWhoseSendersWereNotRecorded) {
  using Work = Scheduler::Work;
  Profiling profiling(2);
  for (int turn = 0; turn < 3; ++turn) profiling.took(Work::generate, profiling.next(Work::generate), 5, 1);
  profiling.traffic.begin({1, true});
  profiling.traffic.visit(1);
  profiling.traffic.leave_for(0);
  profiling.traffic.end();
  Manifest manifest;
  manifest.domains.resize(2);
  const RayProfile profile = gather_profile(*make_transport(nullptr, nullptr), manifest, profiling, {});
  EXPECT_EQ(profile.domains[1].rays, 3u);
  EXPECT_EQ(profile.domains[0].rays, 3u);
  const std::vector<RayProfile::Way> ways = {{1, 0, 3}, {RayProfile::Way::camera, 1, 3}};
  EXPECT_EQ(profile.ways, ways);
}

}  // namespace
}  // namespace vitrail::profiling_test
