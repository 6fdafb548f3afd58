// SPDX-License-Identifier: Apache-2.0
// These functions compute the time that a render of limited time has to leave for its end.
#pragma once

#include <cstdint>

#include "farm/plan/options.h"

namespace vitrail {

// Returns when the options' time is taken to begin, for a job that begins to trace at `tracing`. It is the
// job's start, or later where less than half of the time would be left. So each run brings samples, however
// long a scene takes to be partitioned and read.
std::chrono::steady_clock::time_point limit_start(const RenderOptions& options,
                                                  std::chrono::steady_clock::time_point tracing);

// Returns the seconds from the last ray to the end of the program, at most half of the limit: the film has
// samples in the end. The film is put together on rank 0, which took `gather_s` when it last was (0: not
// yet). It is written, which takes `write_s`, hashed and given back, and a picture is made of it.
double ending_time_s(const RenderOptions& options, std::uint64_t film_bytes, int ranks, double write_s,
                     double gather_s);

}  // namespace vitrail
