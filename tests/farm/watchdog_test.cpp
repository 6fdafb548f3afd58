// SPDX-License-Identifier: Apache-2.0
#include "farm/run/watchdog.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "farm/files/signals.h"
#include "scene/system/underway.h"

namespace vitrail::watchdog_test {
namespace {

using namespace std::chrono_literals;
using ::testing::ExitedWithCode;

TEST(Watchdog, EndsAProcessWhoseDiskDoesNotAnswer) {
  const std::filesystem::path file = "/scene.vit/manifest.json";
  const auto hang = [&] {
    Watchdog watchdog(.4);
    watchdog.call_it("rank 1 of 4 (node7)");
    const Underway underway("opening", file);
    std::this_thread::sleep_for(60s);
  };
  EXPECT_EXIT(hang(), ExitedWithCode(4),
              "rank 1 of 4 \\(node7\\): opening /scene.vit/manifest.json has not gone on");
}

TEST(Watchdog, EndsAProcessThatWaitsInsideMpi) {
  const auto hang = [] {
    Watchdog watchdog(.4);
    watchdog.expect_reports();
    for (;;) {  // as MPI does
    }
  };
  EXPECT_EXIT(hang(), ExitedWithCode(4), "starting has not gone on for .* waits inside MPI");
}

// The rank that stood still is gone by then, and another has named it.
TEST(Watchdog, BlamesNobodyOnceItIsToldToEnd) {
  const auto hang = [] {
    Watchdog watchdog(.4);
    watchdog.expect_reports();
    ask_to_stop();
    for (;;) {
    }
  };
  EXPECT_EXIT(hang(), ExitedWithCode(4), "told to end, it waits inside MPI or the system \\(starting\\)");
}

TEST(Watchdog, WaitsForWhoGoesOn) {
  Watchdog watchdog(1);  // a busy machine may stop for some of it
  watchdog.expect_reports();
  const std::filesystem::path file = "/slow";
  for (int i = 0; i < 60; ++i) {
    const Underway underway("opening", file);
    std::this_thread::sleep_for(25ms);
    watchdog.report();
  }
  EXPECT_FALSE(watchdog.has_given_up());
}

}  // namespace
}  // namespace vitrail::watchdog_test
