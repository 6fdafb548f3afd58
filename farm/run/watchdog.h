// SPDX-License-Identifier: Apache-2.0
// A Watchdog is a thread that sees that this process goes on, from before MPI starts until after it ends. It
// needs nothing of the others: where the disk, MPI or a lock holds them for ever it still speaks and ends the
// process.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace vitrail {

// A thread that stands still at one step (scene/system/underway.h) for `patience_s` ends the process, with
// the step's name and exit status 4; so does a main thread that does not report for so long. Time in which
// this process was itself stopped does not count.
class Watchdog {
 public:
  explicit Watchdog(double patience_s);  // 0: it watches nothing
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // Sets how messages call this process, "rank 1 of 4 (node7)". Before that, and in a job of one rank, they
  // call it nothing.
  void call_it(std::string name);

  // The thread that speaks to other ranks calls the second again and again while reports are expected.
  void expect_reports(bool from_now_on = true) { reports_expected_ = from_now_on; }
  void report() { reports_.fetch_add(1, std::memory_order_relaxed); }

  // Returns whether it has found a standstill and said so: the job ends. A thread that sees that ends all
  // ranks; where none does, this process ends some seconds later.
  bool has_given_up() const { return given_up_; }
  // Notes that this rank ends the job, which may hang too.
  void gives_up() { given_up_ = true; }

 private:
  void watch();
  bool stands_still(double since_last_s);
  void say_given_up(const std::string& what);

  double patience_s_;
  std::atomic<bool> reports_expected_ = false, given_up_ = false;
  std::atomic<std::uint64_t> reports_ = 0;
  std::uint64_t seen_reports_ = 0;
  double main_still_s_ = 0;
  std::mutex mutex_;  // of these
  std::string name_;
  bool ended_ = false;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace vitrail
