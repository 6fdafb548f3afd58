// SPDX-License-Identifier: Apache-2.0
// These are the losses where points become floats and directions codes.
#pragma once

#include <array>
#include <cmath>

#include "scene/geometry/vec.h"

namespace vitrail {

// It bounds the error, in length, of a unit vector from encode_direction to decode_direction. The worst of
// 2·10⁷ is 2.92e-7.
inline constexpr double direction_rounding = 3.5e-7;

// A shadow ray to a point of light ends at this part of its way. The object that the light stands in, as
// exported or rounded, is beyond this end, and so is that part of a medium. It is pbrt's number (its
// ShadowEpsilon); Mitsuba has 1 − 9·10⁻⁴, POV-Ray leaves out 10⁻³ of its unit.
inline constexpr double before_point = 1 - 1e-4;

// Returns how far rounding to float can move a point along a unit vector.
inline double rounding_along(Vector3d unit, Point3d p) {
  return 0x1p-24 * (std::abs(unit.x * p.x) + std::abs(unit.y * p.y) + std::abs(unit.z * p.z));
}

// Returns the error, in rad, of a triangle's normal. Its corners p0, p0 + e1, p0 + e2 may be off by `off`
// along the normal. Each corner turns the normal about the opposite side. `twice_area` > 0.
inline double tilt_of(Vector3d e1, Vector3d e2, double twice_area, const std::array<double, 3>& off) {
  return (off[0] * length(e2 - e1) + off[1] * length(e2) + off[2] * length(e1)) / twice_area;
}

}  // namespace vitrail
