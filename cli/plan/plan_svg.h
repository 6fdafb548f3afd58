// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farm/simulator/simulation.h"

namespace vitrail {

struct PlanPoint {
  int ranks = 1;
  SimulationResult result;
};

// Plots seconds against ranks, both logarithmic, beside perfect scaling of the first point;
// each point has its efficiency.
std::string plan_svg(const std::vector<PlanPoint>& points);

}  // namespace vitrail
