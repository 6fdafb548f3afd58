// SPDX-License-Identifier: Apache-2.0
#include "tracer/quadrics/quadric_surface.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/quadrics/curve_hits.h"

namespace vitrail {

namespace {

Vector3d placed_vector(const Affine& to_bundle, Vector3d v) {
  const auto& m = to_bundle.m;
  return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

// Outwards, of a disk +z; any length.
Vector3d outwards(QuadricKind kind, Point3d p) {
  switch (kind) {
    case QuadricKind::sphere:
      return {p.x, p.y, p.z};
    case QuadricKind::cylinder:
      return {p.x, p.y, 0};
    case QuadricKind::disk:
      return {0, 0, 1};
    case QuadricKind::cone:
      return p.z < 1 ? Vector3d{p.x, p.y, 1 - p.z} : Vector3d{0, 0, 1};
    case QuadricKind::paraboloid:
      return {2 * p.x, 2 * p.y, -1};
    case QuadricKind::curve:
      break;
  }
  return {};
}

// Of pbrt's parameters, in the quadric's own space.
struct Chart {
  Point2d uv;
  Vector3d du, dv;
};

Chart pbrt_chart(const Quadric& q, Point3d p, bool with_uv) {
  const double rho = std::sqrt(p.x * p.x + p.y * p.y);
  const double cosine = rho > 0 ? p.x / rho : 1, sine = rho > 0 ? p.y / rho : 0;
  Chart chart;
  if (with_uv) {
    const double angle = portable_atan2(p.y, p.x), phi = angle < 0 ? angle + 2 * pi : angle;
    chart.uv.x = std::min(phi / q.phi_max_rad, 1.0);
  }
  chart.du = Vector3d{-p.y, p.x, 0} * q.phi_max_rad;
  switch (q.kind) {
    case QuadricKind::sphere: {
      const double bottom = q.low <= -1 ? 0 : portable_acos(-q.low);
      const double range = (q.high >= 1 ? pi : portable_acos(-q.high)) - bottom;
      if (with_uv) chart.uv.y = (portable_atan2(rho, -p.z) - bottom) / range;
      chart.dv = Vector3d{-p.z * cosine, -p.z * sine, rho} * range;
      break;
    }
    case QuadricKind::cylinder:
      chart.uv.y = p.z;
      chart.dv = {0, 0, 1};
      break;
    case QuadricKind::disk:
      chart.uv.y = (1 - rho) / (1 - q.low);
      chart.dv = Vector3d{-cosine, -sine, 0} * (1 - q.low);
      break;
    case QuadricKind::cone:
      chart.uv.y = p.z;
      chart.dv = {-cosine, -sine, 1};
      break;
    case QuadricKind::paraboloid:
      chart.uv.y = (p.z - q.low) / (1 - q.low);
      if (rho > 0) chart.dv = Vector3d{cosine / (2 * rho), sine / (2 * rho), 1} * (1 - q.low);
      break;
    case QuadricKind::curve:
      break;
  }
  return chart;
}

Chart chart_of(const Quadric& q, Point3d p, bool with_uv) {
  Chart chart = pbrt_chart(q, p, with_uv);
  if (q.uv == QuadricUv::pbrt) return chart;
  if (q.kind == QuadricKind::sphere) {
    chart.uv.y = 1 - chart.uv.y;
    chart.dv = -chart.dv;
  } else if (q.kind == QuadricKind::disk) {
    chart = {{1 - chart.uv.y, chart.uv.x}, -chart.dv, chart.du};
  }
  return chart;
}

}  // namespace

Point3d placed_point(const Affine& to_bundle, Point3d local) {
  const auto& m = to_bundle.m;
  return Point3d{m[0][3], m[1][3], m[2][3]} + placed_vector(to_bundle, local - Point3d{});
}

Vector3d placed_quadric_normal(const OrientedQuadric& quadric, const Affine& to_bundle, Point3d local) {
  const auto& m = to_bundle.m;
  const auto column = [&](int j) { return Vector3d{m[0][j], m[1][j], m[2][j]}; };
  const Vector3d n = outwards(quadric.quadric.kind, local);
  const Vector3d across = cross(column(1), column(2)) * n.x + cross(column(2), column(0)) * n.y +
                          cross(column(0), column(1)) * n.z;
  const Vector3d unit = normalize(across);
  return mirrors(to_bundle) != quadric.inside_out ? -unit : unit;
}

QuadricPoint quadric_point(const OrientedQuadric& quadric, const Affine& to_bundle, Point3d local,
                           bool uvs_show) {
  if (is_curve(quadric.quadric))
    return curve_point(unpacked_curve(to_bundle.m), local, quadric.quadric.uv == QuadricUv::mitsuba,
                       quadric.inside_out);
  const Chart chart = chart_of(quadric.quadric, local, uvs_show);
  const Vector3d normal = placed_quadric_normal(quadric, to_bundle, local);
  return {placed_point(to_bundle, local),
          normal,
          normal,
          placed_vector(to_bundle, chart.du),
          placed_vector(to_bundle, chart.dv),
          uvs_show ? chart.uv : Point2d{}};
}

}  // namespace vitrail
