// SPDX-License-Identifier: Apache-2.0
#include "tracer/quadrics/quadric_hits.h"

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/quadrics/curve_hits.h"
#include "tracer/quadrics/quadric_hits_lanes.h"
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

// Of the whole surface.
lanes::Quadratic<double> quadratic_of(QuadricKind kind, Point3d p, Vector3d d) {
  const double a = d.x * d.x + d.y * d.y, b = p.x * d.x + p.y * d.y, c = p.x * p.x + p.y * p.y;
  switch (kind) {
    case QuadricKind::sphere:
      return lanes::sphere_quadratic(lanes::fill<double>(p - Point3d{}), lanes::fill<double>(d));
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
  const auto at = lanes::nearest_point(lanes::fill<double>(origin - Point3d{}), lanes::fill<double>(d));
  const Point3d p{at.p.x, at.p.y, at.p.z};
  const auto f = quadratic_of(quadric.kind, p, d);
  QuadricHits hits;
  if (!(f.b * f.b - f.a * f.c >= 0)) return hits;
  const auto [first, second] = lanes::crossings(f, at.nearest, starts_there);
  for (const auto& [s, t, is_hit] : {first, second}) {
    if (!is_hit) continue;
    const Point3d there = on_surface(quadric.kind, p + d * s);
    if (is_within(quadric, there)) hits.at[hits.count++] = {t, there};
  }
  return hits;
}

}  // namespace vitrail
