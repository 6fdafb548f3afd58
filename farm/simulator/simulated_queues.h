// SPDX-License-Identifier: Apache-2.0
// These are the rays that wait on a simulated rank, in memory and on its disk.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "farm/simulator/invariants.h"
#include "farm/simulator/simulation.h"

namespace vitrail {

// It works over any spill, so that tests can put a broken one in its place.
template <class SpillType>
class SimulatedQueues {
 public:
  SimulatedQueues(std::size_t domains, const Machine& machine)
      : spill_(domains, machine.queue_bytes),
        rays_(domains),
        in_memory_(domains),
        bytes_a_ray_(machine.bytes_a_ray),
        rays_of_a_batch_(machine.rays_of_a_batch) {}

  std::size_t domains() const { return rays_.size(); }
  std::uint64_t rays(std::uint32_t domain) const { return rays_[domain]; }
  std::uint64_t bytes_in_memory() const { return bytes_in_memory_; }

  // Returns how many rays, of any domain, went to the disk for it.
  std::uint64_t put(std::uint32_t domain, std::uint64_t rays) {
    rays_[domain] += rays;
    hold(domain, static_cast<std::int64_t>(rays));
    std::uint64_t spilled = 0;
    while (const auto full = spill_.next()) {
      const std::uint64_t written = std::min(in_memory_[*full], rays_of_a_batch_);
      if (written == 0) invariant::broken(fmt::format("no ray in memory waits for domain {}", *full));
      spilled += written;
      hold(*full, -static_cast<std::int64_t>(written));
    }
    return spilled;
  }
  // Takes those in memory first; returns how many come from the disk.
  std::uint64_t take(std::uint32_t domain, std::uint64_t rays) {
    rays_[domain] -= rays;
    const std::uint64_t held = std::min(rays, in_memory_[domain]);
    hold(domain, -static_cast<std::int64_t>(held));
    return rays - held;
  }

 private:
  void hold(std::uint32_t domain, std::int64_t rays) {
    const auto bytes = static_cast<std::uint64_t>(std::abs(rays)) * bytes_a_ray_;
    rays > 0 ? spill_.added(domain, bytes) : spill_.removed(domain, bytes);
    in_memory_[domain] += static_cast<std::uint64_t>(rays);
    bytes_in_memory_ += static_cast<std::uint64_t>(rays) * bytes_a_ray_;
  }

  SpillType spill_;
  std::vector<std::uint64_t> rays_;       // by domain
  std::vector<std::uint64_t> in_memory_;  // of these, the others are on the disk
  std::uint64_t bytes_a_ray_, rays_of_a_batch_;
  std::uint64_t bytes_in_memory_ = 0;
};

}  // namespace vitrail
