// SPDX-License-Identifier: Apache-2.0
#include "farm/files/timeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "farm/conclude/gather_timeline.h"
#include "farm/files/trace_events.h"
#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::timeline_test {
namespace {

using Kind = Timeline::Kind;
using namespace std::chrono_literals;
using ::testing::HasSubstr;

Timeline::Clock::time_point at(std::int64_t ns) {
  return Timeline::Clock::time_point(std::chrono::nanoseconds(ns));
}

TEST(Timeline, KeepsTheLastEventsOfAKindAndCountsTheOthers) {
  constexpr int most = 16;  // of loads: a sixteenth
  Timeline timeline(16 * most);
  timeline.add(Kind::trace, 1, at(5), at(6), {7, 8});
  for (int i = 0; i < most; ++i) timeline.add(Kind::load, 2, at(i), at(i + 1), {i});
  EXPECT_EQ(timeline.left_out(Kind::load), 0u);
  EXPECT_EQ(timeline.events(Kind::load).front().values[0], 0);
  for (int i = most; i < most + 5; ++i) timeline.add(Kind::load, 2, at(i), at(i + 1), {i});
  const std::vector<Timeline::Event> loads = timeline.events(Kind::load);
  ASSERT_EQ(loads.size(), static_cast<std::size_t>(most));
  for (int i = 0; i < most; ++i) EXPECT_EQ(loads[static_cast<std::size_t>(i)].values[0], 5 + i);
  EXPECT_EQ(timeline.left_out(Kind::load), 5u);
  EXPECT_EQ(timeline.events(Kind::trace), (std::vector<Timeline::Event>{{5, 6, 1, {7, 8}}}));
  EXPECT_TRUE(timeline.events(Kind::idle).empty());
}

TEST(Timeline, OneFileHoldsThoseOfManyRanks) {
  EXPECT_EQ(Timeline::most_events(1), Timeline::most_events(16));
  EXPECT_LT(Timeline::most_events(256), Timeline::most_events(16));
  EXPECT_GT(Timeline::most_events(100'000), 1000u);
}

// Two clocks, of which one is ahead; messages take up to a millisecond, and ranks come late.
TEST(ClockOffset, LiesWithinItsError) {
  std::mt19937_64 random(7);
  const auto up_to = [&](std::int64_t ns) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(ns));
  };
  for (int job = 0; job < 1000; ++job) {
    const std::int64_t ahead = job == 0 ? 0 : up_to(2'000'000'000) - 1'000'000'000;
    std::vector<Meeting> own, others;
    std::int64_t now = 0, shortest = 1'000'000'000;
    for (int i = 0; i < 8; ++i) {
      const std::int64_t own_came = now + up_to(1'000'000), others_came = now + up_to(1'000'000),
                         all_came = std::max(own_came, others_came), own_left = all_came + up_to(1'000'000),
                         others_left = all_came + up_to(1'000'000);
      own.push_back({own_came + ahead, own_left + ahead});
      others.push_back({others_came, others_left});
      shortest = std::min(shortest, std::max(own_left, others_left) - std::min(own_came, others_came));
      now = std::max(own_left, others_left);
    }
    const ClockOffset found = clock_offset(own, others);
    EXPECT_LE(std::abs(found.ns - ahead), found.error_ns);
    EXPECT_LE(found.error_ns, shortest) << "no worse than the best meeting";
    if (ahead == 0) {
      EXPECT_EQ(found.ns, 0);
    }
  }
}

TEST(TraceFile, TellsTimesOfRank0sClock) {
  const test::TemporaryDirectory directory;
  Timeline timeline(1 << 10);
  timeline.add(Kind::load, 3, at(6'001'500), at(6'002'000), {12, 4096});
  timeline.add(Kind::counters, 0, at(6'005'000), at(6'005'000), {1, 2, 3, 4});
  RankTimeline told{"a \"host\"", {5'000'000, 250}, 2, {}, {}};
  for (const Kind kind : {Kind::load, Kind::counters})
    told.events[static_cast<std::size_t>(kind)] = timeline.events(kind);
  told.left_out[static_cast<std::size_t>(Kind::trace)] = 9;
  TraceFile file(directory / "trace.json", 1'000'000);
  file.add(0, {"b", {}, 1, {}, {}});
  file.add(1, told);
  file.commit();
  const nlohmann::json trace = test::read_json(directory / "trace.json");
  const nlohmann::json expected_load = {
      {"ph", "X"}, {"pid", 1},      {"tid", 3},          {"ts", 1.5},
      {"dur", .5}, {"cat", "load"}, {"name", "load 12"}, {"args", {{"domain", 12}, {"bytes", 4096}}}};
  const nlohmann::json expected_rays = {
      {"ph", "C"}, {"pid", 1}, {"ts", 5.}, {"name", "rays"}, {"args", {{"waiting", 1}, {"to send", 2}}}};
  EXPECT_THAT(trace["traceEvents"],
              ::testing::AllOf(::testing::Contains(expected_load), ::testing::Contains(expected_rays)));
  EXPECT_EQ(trace["otherData"]["rank 1"]["left_out"]["trace"], 9);
  EXPECT_EQ(trace["otherData"]["rank 1"]["clock_error_ns"], 250);
  EXPECT_THAT(trace.dump(), HasSubstr(R"(rank 1 on a \"host\", 9 earlier events left out)"));
}

}  // namespace
}  // namespace vitrail::timeline_test
