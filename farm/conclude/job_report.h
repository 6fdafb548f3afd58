// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "farm/plan/job.h"
#include "farm/run/stats.h"

namespace vitrail {

// The part of the statistics that was known before the first ray.
void add_plan(RenderStats& stats, const Job& job, const RenderOptions& options, int ranks);

// On rank 0, when the job's statistics are gathered and its film is written or is not to be: completes the
// statistics, says what the film lacks, and writes the profile. `profile`: where the rays went, if
// that was recorded. `samples_before`: of earlier runs, in the film.
void conclude(Job& job, const RenderOptions& options, std::uint64_t samples_before,
              const std::optional<RayProfile>& profile, RenderStats& stats);

// On rank 0: where --stats asks for it.
void write_stats(const RenderOptions& options, const RenderStats& stats);

// On rank 0, last of all, once the picture is made: where that took more memory than all before, the
// statistics are written anew with it.
void add_peak_of_picture(const RenderOptions& options, RenderStats& stats);

// Throws MachineError where a rank took more than `--memory`, of which all is done and written.
void require_kept_memory(const RenderStats& stats);

}  // namespace vitrail
