// SPDX-License-Identifier: Apache-2.0
// Every rank adds its numbers to a round; all ranks decide by the sums, so they decide alike.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vitrail {

struct RoundSums {
  std::int64_t born = 0, died = 0;               // rays
  std::int64_t reserved = 0;                     // rays that may be born without asking again
  std::int64_t wanting = 0;                      // 1: would like to generate more
  std::int64_t full = 0;                         // 1: nothing is to be generated while this is so
  std::int64_t quiet = 0;                        // 1: nothing will be generated before the next decision
  std::int64_t pause = 0;                        // a request for a checkpoint
  std::int64_t interrupted = 0, terminated = 0;  // requests for an end, by INT and by TERM
  std::int64_t time_is_up = 0;                   // another, by the time limit
  std::int64_t profiles = 0;                     // 1: ranks are to record where rays go (run/settling.h)
  std::int64_t settles = 0;                      // 1: homes are to settle once no ray is alive; 2: now
  std::int64_t bad_input = 0, machine_failure = 0;
  std::int64_t items_done = 0;
  std::int64_t samples = 0;
  std::int64_t rays_traced = 0;
  std::int64_t domain_loads = 0;
  std::int64_t idle = 0;     // 1: has nothing to do, and no item left
  std::int64_t working = 0;  // 1: a worker or a loader has something in hand
};
// It is what each rank tells all others beside.
struct RankReport {
  std::int64_t waiting = 0;   // rays that wait to be traced
  std::int64_t resident = 0;  // domains
  std::int64_t items = 0;     // to spare; −1: it has none, and nothing else to do
};
struct Round {
  RoundSums sums;
  std::vector<RankReport> ranks;
};
// Returns the least seconds from one round to the next. Each round tells every rank some numbers of every
// other, which takes longer the more there are; some milliseconds of work are in flight in between.
inline double round_interval_s(int ranks) { return std::max(1e-3, .4e-6 * ranks); }
inline constexpr std::size_t round_values = sizeof(RoundSums) / sizeof(std::int64_t);

}  // namespace vitrail
