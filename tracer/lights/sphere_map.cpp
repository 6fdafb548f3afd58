// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/sphere_map.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

// Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD" (2008). In |x|, |y|: a quadrant of the
// square is an octant above the diagonal, and the one below it folded over the diagonal.
Vector3d equal_area_direction(Point2d point) {
  const double x = 2 * point.x - 1, y = 2 * point.y - 1;
  const double above = 1 - (std::abs(x) + std::abs(y));
  const double radius = 1 - std::abs(above);
  const double angle = radius > 0 ? ((std::abs(y) - std::abs(x)) / radius + 1) * pi / 4 : pi / 4;
  const double across = radius * safe_sqrt(2 - radius * radius);  // √(1 − z²)
  return {std::copysign(across * portable_cos(angle), x), std::copysign(across * portable_sin(angle), y),
          std::copysign(1 - radius * radius, above)};
}

Point2d equal_area_point(Vector3d d) {
  const double radius = safe_sqrt(1 - std::abs(d.z));
  const double angle = portable_atan2(std::abs(d.y), std::abs(d.x)) * (2 / pi);  // [0,1]
  double v = angle * radius, u = radius - v;
  if (d.z < 0) {
    const double folded = 1 - u;
    u = 1 - v;
    v = folded;
  }
  return {(std::copysign(u, d.x) + 1) / 2, (std::copysign(v, d.y) + 1) / 2};
}

}  // namespace

Point2d sphere_point(SphereProjection projection, Vector3d d) {
  if (projection == SphereProjection::equal_area) return equal_area_point(d);
  const double turn = portable_atan2(d.y, d.x) / (2 * pi);
  return {turn < 0 ? turn + 1 : turn, portable_acos(d.z) / pi};
}

Vector3d sphere_direction(SphereProjection projection, Point2d point) {
  if (projection == SphereProjection::equal_area) return equal_area_direction(point);
  const double polar = point.y * pi, turn = point.x * 2 * pi, across = portable_sin(polar);
  return {across * portable_cos(turn), across * portable_sin(turn), portable_cos(polar)};
}

}  // namespace vitrail
