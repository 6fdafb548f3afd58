// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/ray_flow.h"

#include <algorithm>
#include <utility>

namespace vitrail {

namespace {

std::vector<double> sums_of(const std::vector<Workload::Way>& ways) {
  std::vector<double> until;
  for (const Workload::Way& way : ways) until.push_back((until.empty() ? 0 : until.back()) + way.rays);
  return until;
}

// Where those go on to that come of `rays`: few each by a way of its own, many by all ways at once.
template <class Leave>
void go_on(std::uint64_t rays, const std::vector<Workload::Way>& ways, const std::vector<double>& until,
           SimulatedMachine& machine, const Leave& leave) {
  if (ways.empty()) return;
  const double all = until.back() * static_cast<double>(rays);
  if (all >= static_cast<double>(ways.size())) {
    for (const Workload::Way& way : ways)
      leave(way.domain, machine.rounded(way.rays * static_cast<double>(rays)));
    return;
  }
  for (std::uint64_t left = machine.rounded(all); left > 0; --left) {
    const auto way = std::ranges::upper_bound(until, machine.uniform() * until.back()) - until.begin();
    leave(ways[std::min(static_cast<std::size_t>(way), ways.size() - 1)].domain, 1);
  }
}

}  // namespace

RayFlow::RayFlow(const Workload& workload) : workload_(workload), standing_(workload.domains.size()) {
  for (const Workload::Domain& d : workload.domains) until_.push_back(sums_of(d.ways));
  until_.push_back(sums_of(workload.camera.ways));
}

TaskRays RayFlow::trace(std::uint32_t domain, std::uint64_t rays, double before_s, const Domains& resident,
                        SimulatedMachine& machine) {
  TaskRays task;
  task.seconds = before_s;
  enter(domain, rays);
  follow(task, resident, machine);
  return task;
}

TaskRays RayFlow::generate(std::uint64_t rays, const Domains& resident, SimulatedMachine& machine) {
  TaskRays task;
  task.generated = task.born = rays;
  std::uint64_t left = rays;
  go_on(rays, workload_.camera.ways, until_.back(), machine, [&](std::uint32_t domain, std::uint64_t leave) {
    leave = std::min(left, leave);
    enter(domain, leave);
    left -= leave;
  });
  task.died = left;  // they meet nothing
  follow(task, resident, machine);
  return task;
}

void RayFlow::enter(std::uint32_t domain, std::uint64_t rays) {
  if (rays == 0) return;
  if (standing_[domain] == 0) entered_.push_back(domain);
  standing_[domain] += rays;
}

// Domains that rays stand in, the first that was entered first.
void RayFlow::follow(TaskRays& task, const Domains& resident, SimulatedMachine& machine) {
  double tracing_s = workload_.camera.seconds * static_cast<double>(task.generated);
  for (std::size_t i = 0; i < entered_.size(); ++i) {
    const std::uint32_t domain = entered_[i];
    const std::uint64_t rays = std::exchange(standing_[domain], 0);
    if (!resident.contains(domain)) {
      task.made[domain] += rays;
      continue;
    }
    const Workload::Domain& d = workload_.domains[domain];
    tracing_s += d.seconds * static_cast<double>(rays);
    task.traced += rays;
    task.died += rays;
    go_on(rays, d.ways, until_[domain], machine, [&](std::uint32_t to, std::uint64_t leave) {
      enter(to, leave);
      task.born += leave;
    });
  }
  entered_.clear();
  std::uint64_t handled = 0;
  for (const auto& [domain, rays] : task.made) handled += rays;
  task.seconds += 1e-6 + tracing_s * (handled > 0 ? 1 : workload_.at_hand) +
                  machine.costs().ray_handling_s * static_cast<double>(handled);
}

}  // namespace vitrail
