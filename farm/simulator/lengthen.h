// SPDX-License-Identifier: Apache-2.0
// What came of a job up to a moment. Of a long job the beginning, a steady middle and the end are simulated;
// more of the middle is reckoned.
#pragma once

#include <vector>

#include "farm/simulator/simulation.h"

namespace vitrail {

// What a rank did so far.
struct Busy {
  double working_s = 0;  // of all its workers
  double loading_s = 0;
};
// A moment of a job: what came together so far, and the ranks' part in it.
struct Moment {
  SimulationResult sums;
  std::vector<Busy> ranks;
  double link_s = 0;  // that the busiest link sent, or received
};

// Adds to `end` what came between two moments `times` times more. What was most at any moment stays.
void lengthen(Moment& end, const Moment& from, const Moment& to, double times);

// What of the time the ranks were busy, for a job that has ended.
void add_shares(Moment& end, const Machine& machine);

}  // namespace vitrail
