// SPDX-License-Identifier: Apache-2.0
// The machine under a simulated job: its clock, its chance, and what its disks and its network take.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "farm/simulator/simulation.h"

namespace vitrail {

// The same seed gives the same times. Calls that draw a number do so in the order of the calls.
class SimulatedMachine {
 public:
  SimulatedMachine(const Machine& machine, std::uint64_t seed);

  const Machine& costs() const { return costs_; }
  double now_s() const { return now_s_; }
  void set_clock(double now_s) { now_s_ = now_s; }

  // Draw a number.
  double uniform();                      // of [0, 1)
  int pick_rank();                       // any
  double late();                         // how many times as long something takes
  std::uint64_t rounded(double number);  // to one of its neighbours, right in the mean
  double latency_s() { return late() * costs_.latency_s; }
  // Until when a rank's disk reads so much for it: after all that was asked of that disk before.
  double read(int rank, double files, std::uint64_t bytes);
  // When the thread of messages looks next, where something moved at `moved_s` last: it naps longer and
  // longer, and the system wakes it later.
  double next_look_s(double moved_s) const;
  // From the last rank that joins a round to its end on one of them.
  double round_s();

  double sending_s(std::uint64_t rays) const;
  // Until when a rank sends them: after all that it sent before.
  double send(int rank, std::uint64_t rays);
  double write_and_read_s(std::uint64_t rays) const;  // on the scratch disk

 private:
  const Machine costs_;
  std::mt19937_64 random_;
  std::vector<double> disks_;  // until when each reads
  std::vector<double> links_;  // until when each rank sends
  double now_s_ = 0;
};

}  // namespace vitrail
