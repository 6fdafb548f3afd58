// SPDX-License-Identifier: Apache-2.0
// It is the machine under a simulated job: its clock, its chance, and the times of its disks and its network.
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

  // These draw a number.
  double uniform();                      // of [0, 1)
  int pick_rank();                       // any
  double late();                         // how many times as long something takes
  std::uint64_t rounded(double number);  // to one of its neighbours, right in the mean
  double latency_s() { return late() * costs_.latency_s; }
  // Returns when a rank's disk has read so much for it: after all that was asked of that disk before, and
  // when the server has opened the files, after those that anybody wanted before.
  double read(int rank, double files, std::uint64_t bytes);
  // Returns when the thread of messages looks next, where something moved at `moved_s` last: it naps longer
  // and longer, and the system wakes it later.
  double next_look_s(double moved_s) const;
  // Returns the seconds from the last rank that joins a round to its end on one of them.
  double round_s();

  // Returns when rays from one rank have come to another: after all that the sender's link sends, and that
  // the receiver's receives. Draws a number.
  double arrival_s(int from, int to, std::uint64_t rays);
  // Returns how long the busiest of all links and ways was busy.
  double busiest_link_s() const;
  // Returns the seconds until the films of all ranks are one. They go up a tree, of which every step takes a
  // film, as the slower of link and rank has it.
  double reduction_s() const;
  double write_and_read_s(std::uint64_t rays) const;  // on the scratch disk

 private:
  const Machine costs_;
  std::mt19937_64 random_;
  struct Way {
    double until_s = 0;  // it is busy
    double busy_s = 0;   // in all
  };
  std::vector<double> disks_;  // until when each reads
  double files_until_s_ = 0;   // until when the server opens files
  std::vector<Way> out_, in_;  // of each link
  double now_s_ = 0;
};

}  // namespace vitrail
