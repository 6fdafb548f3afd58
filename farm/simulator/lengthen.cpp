// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/lengthen.h"

#include <algorithm>
#include <type_traits>

namespace vitrail {

void lengthen(Moment& end, const Moment& from, const Moment& to, double times) {
  using Sums = SimulationResult;
  const auto more = [&](auto& all, auto before, auto after, double share = 1) {
    const double added = share * times * (static_cast<double>(after) - static_cast<double>(before));
    all += static_cast<std::decay_t<decltype(all)>>(added);
  };
  for (double Sums::*seconds : {&Sums::seconds, &Sums::busy_s})
    more(end.sums.*seconds, from.sums.*seconds, to.sums.*seconds);
  for (std::uint64_t Sums::*count :
       {&Sums::messages, &Sums::rays, &Sums::forwarded_rays, &Sums::evictions, &Sums::spilled_rays})
    more(end.sums.*count, from.sums.*count, to.sums.*count);
  // What comes where nothing has to leave comes once.
  const auto loads = static_cast<double>(to.sums.loads - from.sums.loads),
             evictions = static_cast<double>(to.sums.evictions - from.sums.evictions);
  const double again = loads > 0 ? std::min(1.0, evictions / loads) : 0;
  for (std::uint64_t Sums::*count : {&Sums::loads, &Sums::loaded_bytes})
    more(end.sums.*count, from.sums.*count, to.sums.*count, again);
  more(end.link_s, from.link_s, to.link_s);
  for (std::size_t r = 0; r < end.ranks.size(); ++r) {
    more(end.ranks[r].working_s, from.ranks[r].working_s, to.ranks[r].working_s);
    more(end.ranks[r].loading_s, from.ranks[r].loading_s, to.ranks[r].loading_s, again);
  }
}

void add_shares(Moment& end, const Machine& machine) {
  SimulationResult& all = end.sums;
  const double worker_s = all.seconds * static_cast<double>(machine.workers);
  for (const Busy& rank : end.ranks) {
    all.busiest_workers = std::max(all.busiest_workers, rank.working_s / worker_s);
    all.busiest_loader = std::max(all.busiest_loader, std::min(1.0, rank.loading_s / all.seconds));
  }
  all.busiest_link = end.link_s / all.seconds;
  all.efficiency = all.busy_s / (worker_s * static_cast<double>(end.ranks.size()));
}

}  // namespace vitrail
