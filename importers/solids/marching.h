// SPDX-License-Identifier: Apache-2.0
// This function finds the zero of a function in a container, from a lattice of its values.
#pragma once

#include "importers/solids/halving.h"
#include "importers/solids/implicit.h"

namespace vitrail::solids {

// They say on what a triangle lies: the zero, or what closes it. A box has a bit a side, lower before upper.
inline constexpr Lies on_zero = 1, on_sphere = 2, on_first_side = 2;

struct March {
  std::vector<Point3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Lies> lies;  // an entry a triangle
  double cell = 0;         // the greatest edge of the lattice's cells
};

March march(const Implicit& implicit);

}  // namespace vitrail::solids
