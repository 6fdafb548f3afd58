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

// Some ranks hang: this one says which, and cannot end together with them (Transport::abandon).
struct SilentRanks : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Called by every rank with the same options. Writes the film, or a checkpoint if it is stopped before the
// end, and the statistics; all on rank 0. The job's statistics are returned on rank 0. Errors end the job on
// all ranks: the rank that failed throws what happened, the others OtherRankFailed. Throws SilentRanks, on
// one rank or more.
RenderStats render(Transport& transport, const RenderOptions& options);

}  // namespace vitrail
