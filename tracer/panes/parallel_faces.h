// SPDX-License-Identifier: Apache-2.0
// These functions say how far faces of panes are off parallel: both the tolerance of real glass and the angle
// of a face, for reports. parallel_way (pane_walk.h) decides by the same measure which light goes on behind
// glass as it came.
#pragma once

#include <cmath>

#include "scene/geometry/vec.h"
#include "tracer/rays/rounding.h"

namespace vitrail {

// It is the slope of a face of a real pane. Float glass of 6 mm keeps its thickness within ± 0.2 mm (EN
// 572-2) over a ribbon of 3.2 m. Its faces are thus up to 1.2·10⁻⁴ rad off.
inline constexpr double float_glass_rad = 6e-5;

// It compares the face that light meets along `direction` with the normal that would let it out along
// `to_light`. The parts of index · direction along the face are equal on both sides. What is left of
// direction − eta · to_light is thus along that normal. eta is that of `refract`. The ratio of the two
// members is the sine of the angle.
struct OffNormal {
  double along_face, length;
};
inline OffNormal off_normal(Vector3d direction, Vector3d to_light, double eta, Vector3d normal) {
  const Vector3d across = direction - to_light * eta;
  return {length(cross(across, normal)), length(across)};
}

// Returns the sine of the angle by which the face is off, less the rounding of directions; > 1: it lets no
// light out there.
inline double wedge_of(Vector3d direction, Vector3d to_light, double eta, Vector3d normal) {
  if (!(dot(to_light, normal) < 0)) return 2;
  const OffNormal face = off_normal(direction, to_light, eta, normal);
  const double off = face.along_face - direction_rounding * (1 + eta);
  return off <= 0 ? 0 : off / face.length;
}

}  // namespace vitrail
