// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bundle/ray_profile.h"
#include "farm/run/profiling.h"
#include "farm/run/stats.h"
#include "farm/transport/transport.h"

namespace vitrail {

// Returns where the rays of all ranks went; it is whole on rank 0. All ranks call it. `stats` holds the
// job's, on rank 0.
RayProfile gather_profile(Transport& transport, const Manifest& manifest, const Profiling& mine,
                          const RenderStats& stats);

}  // namespace vitrail
