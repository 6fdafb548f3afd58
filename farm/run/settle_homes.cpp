// SPDX-License-Identifier: Apache-2.0
#include "farm/run/settle_homes.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "farm/run/gather_profile.h"
#include "farm/transport/doing.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

// Rank 0's, on all.
Homes shared(Transport& transport, const Homes& homes) {
  std::vector<std::uint32_t> ends;
  for (std::uint32_t d = 0; d < homes.domains(); ++d) {
    ends.push_back(static_cast<std::uint32_t>(homes.first(d)));
    ends.push_back(static_cast<std::uint32_t>(homes.last(d)));
  }
  transport.broadcast_from_root(std::span(ends));
  std::vector<int> first, last;
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    first.push_back(static_cast<int>(ends[i]));
    last.push_back(static_cast<int>(ends[i + 1]));
  }
  return {std::move(first), std::move(last), homes.ranks()};
}

// Of the time that ranks traced while they recorded; on rank 0.
double busiest_over_mean(Transport& transport, const Profiling& mine) {
  std::vector<std::int64_t> busiest_ns{std::llround(1e9 * mine.all_s())};
  std::vector<double> all_s{mine.all_s()};
  transport.max_to_root(busiest_ns);
  transport.sum_to_root(std::span(all_s));
  return 1e-9 * static_cast<double>(busiest_ns[0]) * transport.size() / std::max(all_s[0], 1e-9);
}

template <class Step>
void or_fail(RankState& state, const Step& step) {
  try {
    step();
  } catch (...) {
    fail(state, std::current_exception());
  }
}

// Those that are to be traced at other homes wait for being sent. Returns how many they are.
std::uint64_t send_on(const Locked&, RankState& state, const Homes& homes) {
  std::uint64_t all = 0;
  for (std::uint32_t d = 0; d < homes.domains(); ++d)
    for (std::uint64_t left = state.scheduler.leaving(d, homes), rays = 0; left > 0;
         left -= std::min(left, rays)) {
      RayBatch batch = state.queues.pop(d);
      rays = batch.count();
      state.scheduler.leave(d, rays);
      state.outgoing.push(std::move(batch));
      all += rays;
    }
  return all;
}

}  // namespace

void require_all_may_settle(Transport& transport, JobPlan& plan) {
  std::int64_t may_not[] = {!plan.may_settle};
  transport.max_to_root(may_not);
  if (transport.rank() == 0) plan.may_settle = may_not[0] == 0;
}

void settle_homes(Transport& transport, RankState& state, Job& job, const RenderOptions& options,
                  RenderStats& stats) {
  const Manifest& manifest = state.scene.manifest;
  JobPlan& plan = job.plan;
  const bool is_root = transport.rank() == 0;
  now_doing("settling the homes of domains");
  const RayProfile profile = gather_profile(transport, manifest, *state.work.profiling, {});
  Homes homes = plan.homes;
  const std::uint64_t room = plan.memory.domains_bytes + plan.profile_bytes;
  const double busiest = busiest_over_mean(transport, *state.work.profiling);
  constexpr double equal_enough = 1.1;
  if (is_root && busiest >= equal_enough)
    or_fail(state, [&] {
      if (auto better = better_homes(manifest, profile, plan.homes, room)) homes = std::move(*better);
    });
  homes = shared(transport, homes);
  if (options.outputs.profile.empty()) state.work.profiling.reset();
  const std::size_t moved = domains_moved(plan.homes, homes);
  if (is_root && moved > 0 && !options.outputs.quiet)
    say("vitrail: homes settled after {:.0f} s: {} of {} domains moved; the busiest rank had {:.2f} times "
        "the "
        "mean work, and can have {:.2f} times now\n",
        state.elapsed_s(), moved, manifest.domains.size(), busiest, busiest_over_mean(homes, profile));
  state.finished = false;
  if (moved == 0 || state.failure) return state.scheduler.resume();
  std::uint64_t rays = 0;
  or_fail(state, [&] { rays = send_on(Locked(state), state, homes); });
  const Locked locked(state);
  if (state.failure) return;
  stats.settled = {state.elapsed_s(), moved, rays, -state.work.trace_s};  // rest is added in the end
  plan.homes = std::move(homes);
  plan.memory.domains_bytes += std::exchange(plan.profile_bytes, 0);
  state.domains.begin(state.scheduler.settle(plan.homes, plan.memory.domains_bytes));
}

}  // namespace vitrail
