// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/simulated_rounds.h"

namespace vitrail {

namespace {

// What a scheduler, and whoever looks for an end or a checkpoint here, puts in.
void add(RoundSums& to, const RoundSums& from) {
  to.born += from.born;
  to.reserved += from.reserved;
  to.wanting += from.wanting;
  to.full += from.full;
  to.died += from.died;
  to.quiet += from.quiet;
  to.idle += from.idle;
  to.working += from.working;
  to.machine_failure += from.machine_failure;
  to.pause += from.pause;
  to.items_done += from.items_done;
}

}  // namespace

bool SimulatedRounds::join(std::uint64_t round, int rank, const RoundSums& mine, const RankReport& report) {
  Open& open = open_[round];
  add(open.sums, mine);
  if (!open.reports) open.reports = std::make_shared<std::vector<RankReport>>(ranks_);
  (*open.reports)[static_cast<std::size_t>(rank)] = report;
  return ++open.joined == ranks_;
}

SimulatedRounds::Told SimulatedRounds::leave(std::uint64_t round) {
  Open& open = open_.at(round);
  Told told{open.sums, open.reports};
  if (++open.left == ranks_) open_.erase(round);
  return told;
}

}  // namespace vitrail
