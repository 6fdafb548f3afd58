// SPDX-License-Identifier: Apache-2.0
#include "scene/system/underway.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace vitrail::underway_test {
namespace {

using namespace std::chrono_literals;

constexpr double tick_s = 1;  // of the watcher's clock, which need not be true

// A thread that does something until the test ends, seen from the first look on, until it stands still for
// `enough_s`: a busy machine may let it fall asleep late.
template <class Work>
std::optional<Standstill> after_looks(int looks, const Work& work, double enough_s = 1e9) {
  std::atomic<bool> begun = false, over = false;
  std::thread thread([&] { work(begun, over); });
  while (!begun) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(20ms);  // it is in its sleep
  std::optional<Standstill> found;
  for (int i = 0; i < looks && !(found && found->seconds >= enough_s); ++i) {
    std::this_thread::sleep_for(10ms);
    found = longest_standstill(tick_s, 0);
  }
  over = true;
  over.notify_all();
  thread.join();
  return found;
}

void wait_until(const std::atomic<bool>& over) { over.wait(false); }

TEST(Underway, WhoStandsStillIsFoundWithItsFile) {
  const std::filesystem::path file = "/scene.vit/domains/7";
  const auto found = after_looks(
      1000,
      [&](std::atomic<bool>& begun, std::atomic<bool>& over) {
        const Underway outer("loading a domain");
        const Underway inner("opening", file);
        begun = true;
        wait_until(over);
      },
      2 * tick_s);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->what, "opening /scene.vit/domains/7");
  EXPECT_TRUE(found->at_file);
  EXPECT_GE(found->seconds, 2 * tick_s);
}

TEST(Underway, WhoWorksBeginsOrHasEndedDoesNotStandStill) {
  const auto computing = after_looks(20, [](std::atomic<bool>& begun, std::atomic<bool>& over) {
    const Underway underway("tracing rays");
    begun = true;
    while (!over) {
    }
  });
  EXPECT_TRUE(!computing || computing->seconds < 19 * tick_s) << "a busy machine may hold it for a moment";
  EXPECT_FALSE(after_looks(4, [](std::atomic<bool>& begun, std::atomic<bool>& over) {
    { const Underway ended("reading"); }
    begun = true;
    wait_until(over);
  }));
}

}  // namespace
}  // namespace vitrail::underway_test
