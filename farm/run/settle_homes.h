// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farm/plan/job.h"
#include "farm/run/rank_state.h"
#include "farm/run/stats.h"
#include "farm/transport/transport.h"

namespace vitrail {

// Rank 0 decides when homes settle: there plan.may_settle stays where it is set on all ranks.
void require_all_may_settle(Transport& transport, JobPlan& plan);

// Gives the domains homes of equal work, as this job's profile saw it, and ends the profile. Where ranks had
// about equal work the homes stay. All ranks call it together, while no worker lives. Rays that wait are sent
// to the new homes. What goes wrong is left in the state: rays are under way, and the next round ends the
// job. It adds to `stats` what came of it, the same on every rank.
void settle_homes(Transport& transport, RankState& state, Job& job, const RenderOptions& options,
                  RenderStats& stats);

}  // namespace vitrail
