// SPDX-License-Identifier: Apache-2.0
#include "tracer/quadrics/quadric_hits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/geometry/portable_math.h"
#include "tracer/quadrics/curve_hits.h"
#include "tracer/rays/ray.h"

namespace vitrail {

namespace {

struct LocalRay {
  Point3d origin;
  Vector3d direction;
};

Vector3d direction_of(const RayConstants& ray) {
  double d[3];
  d[ray.x] = ray.exact_shear_x * ray.direction_z;
  d[ray.y] = ray.exact_shear_y * ray.direction_z;
  d[ray.z] = ray.direction_z;
  return {d[0], d[1], d[2]};
}

// From where the origin of the quadric's space stands.
Vector3d origin_of(const RayConstants& ray, const Affine& to_bundle) {
  const auto& m = to_bundle.m;
  return {double{ray.origin[0]} - m[0][3], double{ray.origin[1]} - m[1][3], double{ray.origin[2]} - m[2][3]};
}

// By cofactors. Where the transform cannot be inverted nothing is finite, and every comparison says no.
LocalRay to_local(const RayConstants& ray, const Affine& to_bundle) {
  const auto& m = to_bundle.m;
  const Vector3d direction = direction_of(ray), from = origin_of(ray, to_bundle);
  const auto column = [&](int j) { return Vector3d{m[0][j], m[1][j], m[2][j]}; };
  const Vector3d x = cross(column(1), column(2)), y = cross(column(2), column(0)),
                 z = cross(column(0), column(1));
  const double scale = 1 / dot(column(0), x);
  return {{dot(x, from) * scale, dot(y, from) * scale, dot(z, from) * scale},
          {dot(x, direction) * scale, dot(y, direction) * scale, dot(z, direction) * scale}};
}

// a·s² + 2b·s + c of the whole surface at p + s·d.
struct Quadratic {
  double a, b, c;
};

Quadratic quadratic_of(QuadricKind kind, Point3d p, Vector3d d) {
  const double a = d.x * d.x + d.y * d.y, b = p.x * d.x + p.y * d.y, c = p.x * p.x + p.y * p.y;
  switch (kind) {
    case QuadricKind::sphere:
      return {a + d.z * d.z, b + p.z * d.z, c + p.z * p.z - 1};
    case QuadricKind::cylinder:
      return {a, b, c - 1};
    case QuadricKind::disk:
      return {0, d.z / 2, p.z};
    case QuadricKind::cone: {
      const double below = 1 - p.z;
      return {a - d.z * d.z, b + below * d.z, c - below * below};
    }
    case QuadricKind::paraboloid:
      return {a, b - d.z / 2, c - p.z};
    case QuadricKind::curve:
      break;
  }
  return {0, 0, 1};
}

// Where rounding left a point beside the surface it is brought back along an axis that the surface is not
// parallel to, so that what is found from it is as exact as it is.
Point3d on_surface(QuadricKind kind, Point3d p) {
  const auto scaled_to = [&](double wanted) {
    const double rho = std::sqrt(p.x * p.x + p.y * p.y), k = rho > 0 ? wanted / rho : 0;
    return Point3d{p.x * k, p.y * k, p.z};
  };
  switch (kind) {
    case QuadricKind::sphere: {
      const double k = 1 / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
      return {p.x * k, p.y * k, p.z * k};
    }
    case QuadricKind::cylinder:
      return scaled_to(1);
    case QuadricKind::disk:
      return {p.x, p.y, 0};
    case QuadricKind::cone:
      return scaled_to(1 - p.z);
    case QuadricKind::paraboloid:
      return {p.x, p.y, p.x * p.x + p.y * p.y};
    case QuadricKind::curve:
      break;
  }
  return p;
}

bool is_within(const Quadric& q, Point3d p) {
  switch (q.kind) {
    case QuadricKind::sphere:
      if (!(q.low <= p.z || q.low <= -1) || !(p.z <= q.high || q.high >= 1)) return false;
      break;
    case QuadricKind::disk: {
      const double square = p.x * p.x + p.y * p.y;
      if (!(q.low * q.low <= square && square <= 1)) return false;
      break;
    }
    case QuadricKind::paraboloid:
      if (!(q.low <= p.z && p.z <= 1)) return false;
      break;
    default:
      if (!(0 <= p.z && p.z <= 1)) return false;
  }
  if (is_whole_turn(q)) return true;
  const double phi = portable_atan2(p.y, p.x);
  return (phi < 0 ? phi + 2 * pi : phi) <= q.phi_max_rad;
}

}  // namespace

// The quadratic is solved from the point of the line that is nearest to the middle, where nothing is large:
// from 10⁶ radii away, too, roots are off by what rounding moves that point.
QuadricHits quadric_hits(const RayConstants& ray, const Affine& to_bundle, const Quadric& quadric,
                         bool starts_there) {
  if (is_curve(quadric))
    return curve_hits(origin_of(ray, to_bundle), direction_of(ray), unpacked_curve(to_bundle.m),
                      starts_there);
  const auto [origin, d] = to_local(ray, to_bundle);
  const Vector3d away = origin - Point3d{};
  const double nearest = -dot(away, d) / dot(d, d);
  const Point3d p = origin + d * nearest;
  const auto [a, b, c] = quadratic_of(quadric.kind, p, d);
  const double discriminant = b * b - a * c;
  QuadricHits hits;
  if (!(discriminant >= 0)) return hits;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  double roots[2];
  int count = 0;
  if (q != 0) roots[count++] = c / q;
  if (a != 0) roots[count++] = q / a;
  if (count == 2 && roots[1] < roots[0]) std::swap(roots[0], roots[1]);
  const auto t_of = [&](int i) { return nearest + roots[i]; };
  int start = -1;
  if (starts_there && count > 0) start = count == 2 && std::abs(t_of(1)) < std::abs(t_of(0)) ? 1 : 0;
  for (int i = 0; i < count; ++i) {
    const double t = t_of(i);
    if (i == start || !(t > 0) || !std::isfinite(t)) continue;
    const Point3d at = on_surface(quadric.kind, p + d * roots[i]);
    if (is_within(quadric, at)) hits.at[hits.count++] = {t, at};
  }
  return hits;
}

}  // namespace vitrail
