// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/geometry/vec.h"

namespace vitrail {

// It is the directions within `half_rad` of a unit axis; π: all.
struct NormalCone {
  Vector3d axis{0, 0, 1};
  double half_rad = 0;
};

// Returns the least cone around two.
NormalCone united(NormalCone a, NormalCone b);

}  // namespace vitrail
