// SPDX-License-Identifier: Apache-2.0
// The cost model: where to put an interface.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "partitioner/cut.h"

namespace vitrail {

// How a cell is to be divided: into so many leaves on each side.
struct Division {
  std::uint32_t leaves_below = 1, leaves_above = 1;
  double tolerance = 0.1;  // the greatest load imbalance that is still a matter of cost
};

// `items`: the bounds of triangles and pieces in the cell, or of a sample of them. With n of them, s of them
// cut, and A the section of their bounding box (of surface S):
//
//   cost = 2A/S + 2s/n + imbalance,
//   imbalance = max(n_below/leaves_below, n_above/leaves_above) / (n/leaves) − 1,
//
// over candidates with an imbalance within the tolerance; where there are none, the least imbalance. 2A/S is
// the probability that a random line through the box crosses the section (Crofton). Candidates are ends of
// triangles at quantiles around the balanced split, so that a cut follows the edges of a mesh where it can,
// and evenly spaced planes. Counts are of 16384 items at most. Empty where no plane has something on either
// side.
std::optional<Plane> choose_plane(std::span<const Bounds3f> items, const Division& division);

}  // namespace vitrail
