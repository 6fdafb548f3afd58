// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farm/plan/options.h"

namespace vitrail {

// Takes what Slurm and the control groups give the job of this process, where the user gives no other:
// memory, this rank's share of its node's less a tenth for MPI and the system; and, on rank 0, which watches
// the clock and says both, the time until Slurm's job has to have stopped.
void take_limits_of_job(RenderOptions& options, bool rank_0);

}  // namespace vitrail
