// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/simulated_world.h"

#include <algorithm>

namespace vitrail {

void SimulatedWorld::send(const SimulationEvent& event) {
  events.at(machine.now_s() + machine.latency_s(), event);
}

// What is allowed bounds generating: rays are counted when camera rays come on top of the others.
void SimulatedWorld::count(const TaskRays& task) {
  if (task.generated > 0) result.most_alive = std::max(result.most_alive, alive + task.generated);
  alive += task.born;
  alive -= task.died;
  result.rays += task.traced;
}

}  // namespace vitrail
