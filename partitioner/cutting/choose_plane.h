// SPDX-License-Identifier: Apache-2.0
// The cost model decides where to put an interface.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "partitioner/cutting/cut.h"

namespace vitrail {

// A cell is to be divided into so many domains, two or more, of which either side gets at least `least`.
struct Division {
  std::uint32_t domains = 2, least = 1;
  double tolerance = 0.1;  // the greatest load imbalance that is still a matter of cost
};

// An Item is a triangle, a piece or an instance.
struct Item {
  Bounds3f bounds;
  float work = 1;  // of tracing it, in proportion to the mean over all of the scene
};

struct Cut {
  Plane plane;
  std::uint32_t domains_below = 1;  // as many of the domains as it has of the work
};

// `items` are those of the cell or a sample of them. A plane cuts s of n; S is the surface of their bounding
// box. Either side has work wᵢ in a box of surface Sᵢ that becomes kᵢ domains of k. The plane minimises
//
//   cost = Σ Sᵢ/S·(kᵢ/k)^½ + s/n + imbalance/2,  imbalance = max(wᵢ/kᵢ)/(w/k) − 1,
//
// over candidates with an imbalance within the tolerance; where there are none, the imbalance alone. Sᵢ/S is
// the probability that a random line through the box meets that side (Crofton). It meets about √k of k
// domains, so dense parts get boxes of their own. Candidates are ends of items at quantiles, so that a cut
// follows the edges of a mesh where it can, and evenly spaced planes. Counts are of 16384 items at most.
// Returns none where no plane has something on either side.
std::optional<Cut> choose_plane(std::span<const Item> items, const Division& division);

// Returns a plane to compare with. It has half of the domains on either side of the middle centre of the
// items' boxes, on the axis on which they reach farthest.
std::optional<Cut> median_plane(std::span<const Item> items, const Division& division);

}  // namespace vitrail
