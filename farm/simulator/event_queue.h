// SPDX-License-Identifier: Apache-2.0
// An EventQueue gives the event that is next under the simulated clock.
#pragma once

#include <cstdint>
#include <queue>

namespace vitrail {

struct SimulationEvent {
  // Events behind `wants_rest` alone bring nothing on.
  enum class Kind {
    task_done,
    load_done,
    message,
    head,        // of a message in two parts
    wants_rest,  // of it: the sender hears that the head came
    items,       // that another rank gave
    round_begins,
    round_ends,
    watch,
    ask,
    look,  // for messages that came, and for rays to send
    answer,
    checkpoint
  };
  Kind kind = Kind::task_done;
  int rank = 0;
  // It is the number of the message or its head, of the domain that was loaded, or of the worker of the task;
  // or it counts items.
  std::uint64_t number = 0;
  double time = 0;
  std::uint64_t order = 0;  // of events at one time
  bool operator<(const SimulationEvent& e) const { return time != e.time ? time > e.time : order > e.order; }
};

// It gives the earliest event first; of those at one time, the one that was put in first.
class EventQueue {
 public:
  void at(double time_s, SimulationEvent event);
  bool empty() const { return events_.empty(); }
  SimulationEvent pop();  // there is one

 private:
  std::priority_queue<SimulationEvent> events_;
  std::uint64_t next_order_ = 0;
};

}  // namespace vitrail
