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

// A face that light meets on its way along `direction`, against the normal that would let it out along
// `to_light`: the parts of index · direction along the face are equal on both sides, so what is left of
// direction − eta · to_light is along the normal. eta as of `refract`. Their ratio is the sine of the angle.
struct OffNormal {
  double along_face, length;
};
inline OffNormal off_normal(Vector3d direction, Vector3d to_light, double eta, Vector3d normal) {
  const Vector3d across = direction - to_light * eta;
  return {length(cross(across, normal)), length(across)};
}

// By how much the face is off, sin of the angle, less what directions are rounded by; > 1: it lets none out
// there.
inline double wedge_of(Vector3d direction, Vector3d to_light, double eta, Vector3d normal) {
  if (!(dot(to_light, normal) < 0)) return 2;
  const OffNormal face = off_normal(direction, to_light, eta, normal);
  const double off = face.along_face - direction_rounding * (1 + eta);
  return off <= 0 ? 0 : off / face.length;
}

}  // namespace vitrail
