// SPDX-License-Identifier: Apache-2.0
// How far faces of panes are off parallel: what real glass may be, and what a face is, for those who are told
// of it. Which light goes on behind glass as it came, by the same measure, is parallel_way's (pane_walk.h).
#pragma once

#include <cmath>

#include "scene/geometry/vec.h"
#include "tracer/rays/rounding.h"

namespace vitrail {

// A face of a real pane: float glass of 6 mm keeps its thickness within ± 0.2 mm (EN 572-2) over a ribbon of
// 3.2 m, so that its faces are up to 1.2·10⁻⁴ rad off.
inline constexpr double float_glass_rad = 6e-5;

// By how much a face that light on its way along `direction` meets is off the normal that would let it out
// along `to_light`, sin of the angle: the parts of index · direction along the face are equal on both sides.
// Less what directions are rounded by. eta as of `refract`; > 1: it lets none out there.
inline double wedge_of(Vector3d direction, Vector3d to_light, double eta, Vector3d normal) {
  if (!(dot(to_light, normal) < 0)) return 2;
  const Vector3d across = direction - to_light * eta;  // along the normal
  const double off = length(cross(across, normal)) - direction_rounding * (1 + eta);
  return off <= 0 ? 0 : off / length(across);
}

}  // namespace vitrail
