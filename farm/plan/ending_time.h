// SPDX-License-Identifier: Apache-2.0
// What a render of limited time has to leave for its end.
#pragma once

#include <cstdint>

#include "farm/plan/options.h"

namespace vitrail {

// When the options' time is taken to begin, of a job that begins to trace at `tracing`: at its start, or
// later where less than half of the time would be left, so that each run brings samples, however long a scene
// takes to be partitioned and read.
std::chrono::steady_clock::time_point limit_start(const RenderOptions& options,
                                                  std::chrono::steady_clock::time_point tracing);

// Seconds from the last ray to the end of the program: the film is put together on rank 0, which took
// `gather_s` when it last was (0: not yet), written, which takes `write_s`, hashed and given back, and a
// picture is made of it. Half of the limit at most: what is there in the end has samples.
double ending_time_s(const RenderOptions& options, std::uint64_t film_bytes, int ranks, double write_s,
                     double gather_s);

}  // namespace vitrail
