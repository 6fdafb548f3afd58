// SPDX-License-Identifier: Apache-2.0
// How the memory of a rank is shared out under --memory.
#pragma once

#include <cstdint>

namespace vitrail {

struct MemoryPlan {
  std::uint64_t domains_bytes = 0;  // for mapped domains
  std::uint64_t queue_bytes = 0;    // for rays that wait or travel
};

// `budget` for the whole rank, 0: no limit. `base`: resident already, film and manifest included; `peak`: at
// the highest so far. `largest_domain` has to fit. Throws MachineError with the least budget that would do.
MemoryPlan plan_memory(std::uint64_t budget, std::uint64_t base, std::uint64_t peak, int threads,
                       std::uint64_t largest_domain, std::uint64_t all_domains);

// The most rays that may be alive in the whole job, so that even all of them on one rank fit its queues.
std::int64_t rays_allowed(const MemoryPlan& plan);

}  // namespace vitrail
