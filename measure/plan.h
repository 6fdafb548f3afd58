// SPDX-License-Identifier: Apache-2.0
// A Plan says what a measurement will take, before it begins.
#pragma once

#include <vector>

#include "measure/measure.h"

namespace vitrail {

struct Plan {
  int spp = 1, reference_spp = 1;  // of a picture, and of a half of the reference
  int renders = 0;  // of the reference, the axes, the samples, and the combinations where all are asked for
  int search_renders = 0;  // at most, of the search for recommendations after them
  double wall_s = 0;       // of `renders`, about
};

// `sample_wall_s` is the wall time of a sample of every pixel, `start_wall_s` that of a render
// beside its samples. Samples that the options leave open are those that the budget allows,
// with room for a short search.
Plan make_plan(const MeasureOptions& options, const std::vector<Axis>& axes, double sample_wall_s,
               double start_wall_s);

}  // namespace vitrail
