// SPDX-License-Identifier: Apache-2.0
// Renders a bundle on all ranks of the job.
#pragma once

#include "farm/plan/options.h"
#include "farm/run/stats.h"

namespace vitrail {

// Renders the bundle. Every rank calls it with the same options. Writes the film, or a checkpoint if it is
// stopped before the end, and the statistics; all on rank 0. The job's statistics are returned on rank 0.
// Errors end the job on all ranks: the rank that failed throws what happened, the others OtherRankFailed.
// Where ranks hang, one says which and ends the job at once (Transport::abandon).
RenderStats render(Transport& transport, const RenderOptions& options);

}  // namespace vitrail
