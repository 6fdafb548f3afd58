// SPDX-License-Identifier: Apache-2.0
// A RayFlow moves the rays of a task from domain to domain, as numbers.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "farm/simulator/simulated_machine.h"

namespace vitrail {

// It counts the rays of a task, which are known when it begins.
struct TaskRays {
  std::uint64_t generated = 0, traced = 0;
  std::uint64_t born = 0, died = 0;             // those that are generated are born
  std::map<std::uint32_t, std::uint64_t> made;  // rays that enter absent domains, by domain
  double seconds = 0;                           // of a worker
};

class RayFlow {
 public:
  using Domains = std::set<std::uint32_t>;

  explicit RayFlow(const Workload& workload);

  // Traces rays that wait for a domain; in `resident` domains they go on as far as these reach. `before_s` is
  // added to the task's seconds.
  TaskRays trace(std::uint32_t domain, std::uint64_t rays, double before_s, const Domains& resident,
                 SimulatedMachine& machine);
  // Does the same with so many camera rays, which are born.
  TaskRays generate(std::uint64_t rays, const Domains& resident, SimulatedMachine& machine);

 private:
  void enter(std::uint32_t domain, std::uint64_t rays);
  void follow(TaskRays& task, const Domains& resident, SimulatedMachine& machine);

  const Workload& workload_;
  std::vector<std::vector<double>> until_;  // sums of the ways' rays, by domain, the camera's last
  std::vector<std::uint64_t> standing_;     // rays of the task that is worked out, by domain
  std::vector<std::uint32_t> entered_;      // domains of these
};

}  // namespace vitrail
