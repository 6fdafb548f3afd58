// SPDX-License-Identifier: Apache-2.0
// These functions lengthen the simulation of a long job: its beginning, a steady middle and the end are
// simulated; more of the middle is reckoned.
#pragma once

#include <vector>

#include "farm/simulator/simulation.h"

namespace vitrail {

// It says what a rank did so far.
struct Busy {
  double working_s = 0;  // of all its workers
  double loading_s = 0;
};
// It is a moment of a job: the sums so far, and the ranks' part in them.
struct Moment {
  SimulationResult sums;
  std::vector<Busy> ranks;
  double link_s = 0;  // that the busiest link sent, or received
};

// Adds to `end`, `times` times, the difference of the sums of two moments. The greatest values of any moment
// stay.
void lengthen(Moment& end, const Moment& from, const Moment& to, double times);

// Computes the shares of the time in which the ranks were busy, for a job that has ended.
void add_shares(Moment& end, const Machine& machine);

}  // namespace vitrail
