// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "farm/plan/job.h"
#include "farm/run/stats.h"

namespace vitrail {

// Adds the part of the statistics that was known before the first ray.
void add_plan(RenderStats& stats, const Job& job, const RenderOptions& options, int ranks);

// Completes the statistics, says what the film lacks, and writes the profile. It is called on rank 0, when
// the job's statistics are gathered and its film is written or is not to be. `profile` says where the rays
// went, if that was recorded. `samples_before` counts the samples of earlier runs, in the film.
void conclude(Job& job, const RenderOptions& options, std::uint64_t samples_before,
              const std::optional<RayProfile>& profile, RenderStats& stats);

// Writes the statistics on rank 0, where --stats asks for it.
void write_stats(const RenderOptions& options, const RenderStats& stats);

// Writes the statistics anew, with the new peak, where making the picture took more memory than all before.
// It is called on rank 0, last of all, once the picture is made.
void add_peak_of_picture(const RenderOptions& options, RenderStats& stats);

// Throws MachineError where a rank took more than `--memory`. All is done and written by then.
void require_kept_memory(const RenderStats& stats);

}  // namespace vitrail
