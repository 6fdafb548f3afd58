// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/quadric.h"

#include <algorithm>
#include <cmath>

#include "scene/shapes/curve.h"

namespace vitrail {

namespace {

// The greatest a·z + h·ρ of its points, h ≥ 0.
double farthest(const Quadric& q, double a, double h) {
  switch (q.kind) {
    case QuadricKind::sphere: {
      const double norm = std::hypot(a, h), z = norm > 0 ? std::clamp(a / norm, q.low, q.high) : q.low;
      return a * z + h * std::sqrt(std::max(0.0, 1 - z * z));
    }
    case QuadricKind::cylinder:
      return std::max(a, 0.0) + h;
    case QuadricKind::disk:
      return h;
    case QuadricKind::cone:
      return std::max(a, h);
    case QuadricKind::paraboloid: {
      const double rho = a < 0 ? std::clamp(-h / (2 * a), std::sqrt(q.low), 1.0) : 1;
      return rho * (a * rho + h);
    }
    case QuadricKind::curve:
      break;
  }
  return 0;
}

}  // namespace

bool is_whole_turn(const Quadric& q) { return q.phi_max_rad >= Quadric{}.phi_max_rad; }

bool is_whole_sphere(const Quadric& q) {
  return q.kind == QuadricKind::sphere && is_whole_turn(q) && q.low <= -1 && q.high >= 1;
}

Bounds3d bounds_of(const Quadric& q, const Transform& to) {
  if (is_curve(q)) return bounds_of(unpacked_curve(to));
  Bounds3d box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& row = to.m[axis];
    const double h = std::hypot(row[0], row[1]);
    box.lower[static_cast<int>(axis)] = row[3] - farthest(q, -row[2], h);
    box.upper[static_cast<int>(axis)] = row[3] + farthest(q, row[2], h);
  }
  return box;
}

}  // namespace vitrail
