// SPDX-License-Identifier: Apache-2.0
// This file has the projections of sphere_map.h, for any number of lanes.
#pragma once

#include "scene/geometry/portable_math.h"
#include "tracer/lights/sphere_map.h"
#include "tracer/simd/portable_math_lanes.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

// It is a point of the sphere's picture.
template <class D>
struct PicturePoint {
  D x, y;
};

// This is Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD" (2008). In |x|, |y| a quadrant
// of the square has an octant above the diagonal, and below it the other one, folded over the diagonal.
template <class D>
VITRAIL_LANES Vector<D> equal_area_direction(PicturePoint<D> point) {
  const D x = 2.0 * point.x - 1.0, y = 2.0 * point.y - 1.0;
  const D above = 1.0 - (abs(x) + abs(y));
  const D radius = 1.0 - abs(above);
  const D angle = select<D>(radius > 0, ((abs(y) - abs(x)) / radius + 1.0) * pi / 4.0, fill<D>(pi / 4));
  const D across = radius * safe_sqrt(2.0 - radius * radius);  // √(1 − z²)
  return {abs(across * portable_cos(angle)) * sign_of(x), abs(across * portable_sin(angle)) * sign_of(y),
          abs(1.0 - radius * radius) * sign_of(above)};
}

template <class D>
VITRAIL_LANES PicturePoint<D> sphere_point(SphereProjection projection, Vector<D> d) {
  if (projection == SphereProjection::equal_area) {
    const D radius = safe_sqrt(1.0 - abs(d.z));
    const D angle = portable_atan2(abs(d.y), abs(d.x)) * (2 / pi);  // [0,1]
    const D v = angle * radius, u = radius - v;
    const Mask<D> below = d.z < 0;
    const D x = select<D>(below, 1.0 - v, u), y = select<D>(below, 1.0 - u, v);
    return {(abs(x) * sign_of(d.x) + 1.0) / 2.0, (abs(y) * sign_of(d.y) + 1.0) / 2.0};
  }
  const D turn = portable_atan2(d.y, d.x) / (2 * pi);
  return {select<D>(turn < 0, turn + 1.0, turn), portable_acos(d.z) / pi};
}

}  // namespace
}  // namespace vitrail::lanes
