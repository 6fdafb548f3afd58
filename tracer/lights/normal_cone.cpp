// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/normal_cone.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

Vector3d any_across(Vector3d v) {
  return normalize(std::abs(v.x) < 0.6 ? cross(v, Vector3d{1, 0, 0}) : cross(v, Vector3d{0, 1, 0}));
}

}  // namespace

NormalCone united(NormalCone a, NormalCone b) {
  if (a.half_rad < b.half_rad) std::swap(a, b);
  const double between = portable_acos(dot(a.axis, b.axis));
  if (std::min(between + b.half_rad, pi) <= a.half_rad) return a;
  const double half = (a.half_rad + between + b.half_rad) / 2;
  if (half >= pi) return {a.axis, pi};
  Vector3d across = b.axis - a.axis * dot(a.axis, b.axis);
  across = dot(across, across) > 1e-20 ? normalize(across) : any_across(a.axis);
  const double turn = half - a.half_rad;
  return {normalize(a.axis * portable_cos(turn) + across * portable_sin(turn)), half};
}

}  // namespace vitrail
