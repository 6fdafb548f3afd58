// SPDX-License-Identifier: Apache-2.0
#include "tracer/quadrics/quadric_area.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

// The area of a paraboloid below z goes with (1 + 4z)^{3/2}.
double below(double z) { return (1 + 4 * z) * std::sqrt(1 + 4 * z); }

}  // namespace

double own_area(const Quadric& q) {
  switch (q.kind) {
    case QuadricKind::sphere:
      return q.phi_max_rad * (q.high - q.low);
    case QuadricKind::cylinder:
      return q.phi_max_rad;
    case QuadricKind::disk:
      return q.phi_max_rad * (1 - q.low * q.low) / 2;
    case QuadricKind::cone:
      return q.phi_max_rad / std::sqrt(2.0);
    case QuadricKind::paraboloid:
      return q.phi_max_rad * (below(1) - below(q.low)) / 12;
    case QuadricKind::curve:
      break;
  }
  return 0;
}

Point3d point_by_area(const Quadric& q, double s, double t) {
  const double phi = q.phi_max_rad * s;
  const auto at = [&](double rho, double z) {
    return Point3d{rho * portable_cos(phi), rho * portable_sin(phi), z};
  };
  switch (q.kind) {
    case QuadricKind::sphere: {
      const double z = q.low + (q.high - q.low) * t;
      return at(std::sqrt(std::max(0.0, (1 - z) * (1 + z))), z);
    }
    case QuadricKind::cylinder:
      return at(1, t);
    case QuadricKind::disk:
      return at(std::sqrt(q.low * q.low + (1 - q.low * q.low) * t), 0);
    case QuadricKind::cone: {
      const double rho = std::sqrt(t);
      return at(rho, 1 - rho);
    }
    case QuadricKind::paraboloid: {
      const double root = portable_pow(below(q.low) + (below(1) - below(q.low)) * t, 1 / 3.0);
      const double z = std::clamp((root * root - 1) / 4, q.low, 1.0);
      return at(std::sqrt(z), z);
    }
    case QuadricKind::curve:
      break;
  }
  return {};
}

Point2d place_by_area(const Quadric& q, Point3d p) {
  const double angle = portable_atan2(p.y, p.x);
  const double s = (angle < 0 ? angle + 2 * pi : angle) / q.phi_max_rad;
  switch (q.kind) {
    case QuadricKind::sphere:
      return {s, (p.z - q.low) / (q.high - q.low)};
    case QuadricKind::cylinder:
      return {s, p.z};
    case QuadricKind::disk:
      return {s, (p.x * p.x + p.y * p.y - q.low * q.low) / (1 - q.low * q.low)};
    case QuadricKind::cone:
      return {s, (1 - p.z) * (1 - p.z)};
    case QuadricKind::paraboloid:
      return {s, (below(std::max(p.z, q.low)) - below(q.low)) / (below(1) - below(q.low))};
    case QuadricKind::curve:
      break;
  }
  return {};
}

// dA = |det| / |Mᵀ n| dA′.
double area_stretch(const Affine& to_bundle, Vector3d n) {
  const auto& m = to_bundle.m;
  const auto column = [&](int j) { return Vector3d{m[0][j], m[1][j], m[2][j]}; };
  const Vector3d x = column(0), y = column(1), z = column(2);
  return std::abs(dot(x, cross(y, z))) / length(Vector3d{dot(x, n), dot(y, n), dot(z, n)});
}

}  // namespace vitrail
