// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/event_queue.h"

namespace vitrail {

void EventQueue::at(double time_s, SimulationEvent event) {
  event.time = time_s;
  event.order = next_order_++;
  events_.push(event);
}

SimulationEvent EventQueue::pop() {
  const SimulationEvent first = events_.top();
  events_.pop();
  return first;
}

}  // namespace vitrail
