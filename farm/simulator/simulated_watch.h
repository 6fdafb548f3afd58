// SPDX-License-Identifier: Apache-2.0
// It is a rank's watch over the others: it is looked at when it is due, and its questions go over the
// network.
#pragma once

#include <algorithm>
#include <cmath>

#include "farm/scheduler/watch.h"
#include "farm/simulator/simulated_world.h"

namespace vitrail {

template <class WatchType>
class SimulatedWatch {
 public:
  SimulatedWatch(SimulatedWorld& world, int rank)
      : world_(world),
        rank_(rank),
        watch_(rank, world.machine.costs().ranks, world.machine.costs().patience_s) {}

  void round_begins() {
    watch_.round_begins(world_.machine.now_s());
    expect();
  }
  void round_ends() { watch_.round_ends(); }

  // Takes the watch's next step when that is due.
  void look_after_others() {
    is_expected_ = false;
    const auto step = watch_.step(world_.machine.now_s());
    if (step == Watch::Step::ask_all)
      for (int other = 0; other < world_.machine.costs().ranks; ++other)
        if (other != rank_) world_.send({SimulationEvent::Kind::ask, other, as_number()});
    // The launcher ends all ranks then.
    if (step == Watch::Step::give_up) world_.result.silent = watch_.silent();
    expect();
  }

  // Answers another rank's question at once.
  void asked(int by) {
    watch_.asked(world_.machine.now_s());
    world_.send({SimulationEvent::Kind::answer, by, as_number()});
  }
  void answered(int by) { watch_.answered(by); }

 private:
  void expect() {
    if (is_expected_ || !std::isfinite(watch_.due_s())) return;
    is_expected_ = true;
    world_.events.at(std::max(world_.machine.now_s(), watch_.due_s()), {SimulationEvent::Kind::watch, rank_});
  }
  std::uint64_t as_number() const { return static_cast<std::uint64_t>(rank_); }

  SimulatedWorld& world_;
  int rank_;
  WatchType watch_;
  bool is_expected_ = false;  // the event is on its way
};

}  // namespace vitrail
