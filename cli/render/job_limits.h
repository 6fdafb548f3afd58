// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farm/plan/options.h"
#include "farm/transport/transport.h"

namespace vitrail {

// Takes what Slurm, the control groups and the machine give this process, where the user gives no other, on
// all ranks together. That is memory, this rank's share of its node's (scene/system/machine_limits.h). On
// rank 0, which watches the clock and says both, it is also the time until Slurm's job has to have stopped.
void take_limits_of_job(Transport& transport, RenderOptions& options);

}  // namespace vitrail
