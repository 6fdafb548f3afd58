// SPDX-License-Identifier: Apache-2.0
#include "farm/run/watchdog.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "farm/files/signals.h"
#include "farm/run/stopped_ranks.h"
#include "farm/transport/doing.h"
#include "scene/system/say.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int machine_failed = 4;  // the exit status of that

std::string stopped_here() {
  const std::vector<int> ranks = stopped_ranks_of_host();
  if (ranks.empty()) return {};
  return fmt::format("; of this host's ranks {} {} stopped", fmt::join(ranks, ", "),
                     ranks.size() == 1 ? "is" : "are");
}

}  // namespace

Watchdog::Watchdog(double patience_s) : patience_s_(patience_s) {
  if (patience_s > 0) thread_ = std::thread([this] { watch(); });
}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Watchdog::call_it(std::string name) {
  const std::lock_guard lock(mutex_);
  name_ = std::move(name);
}

void Watchdog::watch() {
  const std::chrono::duration<double> interval(std::clamp(patience_s_ / 20, .02, 1.));
  const double grace_s = std::min(2., patience_s_ / 2);
  double given_up_s = 0;
  Clock::time_point last = Clock::now();
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, interval, [&] { return ended_; })) {
    const std::chrono::duration<double> since_last = Clock::now() - last;
    last = Clock::now();
    const double seen_s = std::min(since_last.count(), 2 * interval.count());
    if (given_up_)
      given_up_s += seen_s;
    else if (stands_still(seen_s))
      given_up_ = true;
    if (given_up_s >= grace_s) std::_Exit(machine_failed);
  }
}

bool Watchdog::stands_still(double since_last_s) {
  const std::uint64_t reports = reports_;
  const bool reported = !reports_expected_ || reports != seen_reports_;
  seen_reports_ = reports;
  main_still_s_ = reported ? 0 : main_still_s_ + since_last_s;
  const auto still = longest_standstill(since_last_s, patience_s_ / 2);
  if (still && std::max(still->seconds, main_still_s_) >= patience_s_) {
    say_given_up(fmt::format("{} has not gone on for {:.3g} s (--patience {})", still->what, still->seconds,
                             patience_s_));
    return true;
  }
  if (main_still_s_ < patience_s_) return false;
  if (stop_signal() != 0) {  // as others do that end the job: who stood still has been named
    say_given_up(fmt::format("told to end, it waits inside MPI or the system ({})", doing()));
    return true;
  }
  say_given_up(
      fmt::format("{} has not gone on for {:.3g} s (--patience {}): it waits inside MPI or the system{}",
                  doing(), main_still_s_, patience_s_, stopped_here()));
  return true;
}

void Watchdog::say_given_up(const std::string& what) {
  say("vitrail: {}{}{}; the job ends; the same command continues from its last checkpoint\n", name_,
      name_.empty() ? "" : ": ", what);
}

}  // namespace vitrail
