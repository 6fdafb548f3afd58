// SPDX-License-Identifier: Apache-2.0
// All ranks of a simulated job share this world: the picture, the machine, what is under way, and the sums.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "farm/simulator/event_queue.h"
#include "farm/simulator/ray_flow.h"
#include "farm/simulator/simulated_machine.h"

namespace vitrail {

using SimulatedMessage = std::vector<std::pair<std::uint32_t, std::uint64_t>>;  // batches: domain, rays

struct SimulatedWorld {
  SimulatedWorld(const Workload& picture, const Machine& of, const Mishaps& wrong, std::uint64_t seed)
      : workload(picture), mishaps(wrong), machine(of, seed), flow(picture) {}

  // Sends an event that a rank hears of by the network.
  void send(const SimulationEvent& event);
  // Counts a task's rays as it begins: the rays that it makes are alive from then on.
  void count(const TaskRays& task);

  const Workload& workload;
  const Mishaps mishaps;
  SimulatedMachine machine;
  RayFlow flow;
  EventQueue events;
  std::map<std::uint64_t, SimulatedMessage> messages;  // under way, by number
  struct Route {
    int from = 0, to = 0;
  };
  std::map<std::uint64_t, Route> routes;  // of those in two parts
  std::uint64_t alive = 0;                // rays
  std::uint64_t generated = 0;            // camera rays, of tasks that are done
  SimulationResult result;
};

}  // namespace vitrail
