// SPDX-License-Identifier: Apache-2.0
// Phases deal out the items that the ranks work on: all of a round, or those of a phase of photon mapping.
// They also begin the next ones when no ray is alive.
#pragma once

#include "farm/run/checkpoint.h"
#include "farm/run/rank_state.h"
#include "farm/scheduler/round.h"

namespace vitrail {

class Phases {
 public:
  // Deals out the first items. `done` holds bits of those of earlier runs.
  Phases(RankState& state, const Place& place, std::vector<std::uint64_t> done);

  // Returns the bound of the numbers of items that ranks may send each other: they are below it.
  std::uint64_t items() const;
  // Returns the items of earlier runs, rounds and phases that the sums of a round are to count too.
  std::int64_t items_done_before() const;
  // They return what the sums of a round say: any_done, on rank 0, whether items were done here; all_done,
  // whether all of the round's plan are.
  bool any_done(const RoundSums& sums) const {
    return !state_.photons_fly() && sums.items_done > static_cast<std::int64_t>(items_before_);
  }
  bool all_done(const RoundSums& sums) const;
  // Begins the next phase when no ray is alive. Returns false where what was begun is not at its end, or
  // nothing of this round is left: the same on every rank.
  bool begin_next(const RoundSums& sums);
  // Begins a round. All items of the round before are done, and the film is whole on rank 0.
  void begin_round(WorkPlan plan);
  int rounds() const { return rounds_; }  // begun here

 private:
  void start_items(const Locked& locked, std::vector<std::uint64_t> done);
  void deal(const Locked& locked, std::vector<std::uint64_t> items);
  void begin_iteration(const Locked& locked, std::uint32_t iteration);
  bool begin_gathering(std::uint64_t chunks_flown);
  bool begin_next_iteration(std::uint64_t items_done);

  RankState& state_;
  Place place_;
  int rounds_ = 1;
  std::uint64_t items_before_ = 0;  // on rank 0: done by earlier runs or rounds; of earlier iterations here
  // They are for photon mapping: the bits of the items done before this run, and the job's items up to this
  // iteration's last.
  std::vector<std::uint64_t> done_before_;
  std::uint64_t items_until_ = 0;
};

}  // namespace vitrail
