// SPDX-License-Identifier: Apache-2.0
#include "scene/system/underway.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <mutex>
#include <vector>

namespace vitrail {

namespace {

struct Step {
  const char* what = nullptr;
  const std::filesystem::path* file = nullptr;
};

// A thread, from its first step to its end.
struct Thread {
  std::mutex mutex;
  clockid_t clock{};
  std::array<Step, 8> steps;  // the outermost first; deeper ones are not named
  std::size_t depth = 0;
  std::uint64_t changes = 0;
  // The watcher's.
  std::uint64_t seen_changes = 0;
  std::int64_t seen_cpu_ns = 0;
  double still_s = 0;

  Thread();
  ~Thread();
};

struct Threads {
  std::mutex mutex;
  std::vector<Thread*> all;
};

// Never destroyed: threads end after main does.
Threads& threads() {
  static auto* const only = new Threads;
  return *only;
}

Thread::Thread() {
  ::pthread_getcpuclockid(::pthread_self(), &clock);
  const std::lock_guard lock(threads().mutex);
  threads().all.push_back(this);
}

Thread::~Thread() {
  const std::lock_guard lock(threads().mutex);
  std::erase(threads().all, this);
}

Thread& this_thread() {
  thread_local Thread only;
  return only;
}

std::int64_t cpu_ns(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

// Its state, as the watcher finds it.
std::optional<Standstill> look_at(Thread& t, double since_last_s) {
  const std::lock_guard lock(t.mutex);
  const std::int64_t cpu = cpu_ns(t.clock);
  const bool goes_on = t.depth == 0 || t.changes != t.seen_changes || cpu != t.seen_cpu_ns;
  t.still_s = goes_on ? 0 : t.still_s + since_last_s;
  t.seen_changes = t.changes;
  t.seen_cpu_ns = cpu;
  if (t.still_s == 0) return std::nullopt;
  const Step& step = t.steps[std::min(t.depth, t.steps.size()) - 1];
  if (!step.file) return Standstill{step.what, t.still_s, false};
  return Standstill{fmt::format("{} {}", step.what, step.file->string()), t.still_s, true};
}

}  // namespace

Underway::Underway(const char* what, const std::filesystem::path* file) {
  Thread& t = this_thread();
  const std::lock_guard lock(t.mutex);
  if (t.depth < t.steps.size()) t.steps[t.depth] = {what, file};
  ++t.depth;
  ++t.changes;
}

Underway::~Underway() {
  Thread& t = this_thread();
  const std::lock_guard lock(t.mutex);
  --t.depth;
  ++t.changes;
}

std::optional<Standstill> longest_standstill(double since_last_s, double at_least_s) {
  std::optional<Standstill> longest;
  const std::lock_guard lock(threads().mutex);
  for (Thread* t : threads().all) {
    std::optional<Standstill> still = look_at(*t, since_last_s);
    if (!still || still->seconds < at_least_s) continue;
    if (!longest || std::pair(still->at_file, still->seconds) > std::pair(longest->at_file, longest->seconds))
      longest = std::move(still);
  }
  return longest;
}

}  // namespace vitrail
