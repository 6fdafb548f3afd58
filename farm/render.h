// SPDX-License-Identifier: Apache-2.0
// Renders a bundle on all ranks of the job.
#pragma once

#include <stdexcept>

#include "farm/options.h"
#include "farm/stats.h"

namespace vitrail {

// This rank did nothing wrong, but the job ends because another one failed, and said why.
struct OtherRankFailed : std::runtime_error {
  explicit OtherRankFailed(bool bad_input_there)
      : std::runtime_error("another rank failed"), bad_input(bad_input_there) {}
  bool bad_input;
};

// Called by every rank with the same options. Writes the film, or a checkpoint if it is stopped before the
// end, and the statistics; all on rank 0. The job's statistics are returned on rank 0. Errors end the job on
// all ranks: the rank that failed throws what happened, the others OtherRankFailed. Where ranks
// hang, one says which and ends the job at once (Transport::abandon).
RenderStats render(Transport& transport, const RenderOptions& options);

}  // namespace vitrail
