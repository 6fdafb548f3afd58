// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/quadrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

void require(bool holds, const char* shape, const char* quantity, double value, const char* what) {
  if (!holds) throw Error(fmt::format("{}: {} is {}, but has to be {}", shape, quantity, value, what));
}

void require_size(double value, const char* shape, const char* quantity) {
  require(value > 0 && std::isfinite(value), shape, quantity, value, "finite and above 0");
  require(std::isfinite(static_cast<float>(value)), shape, quantity, value, "a single-precision number");
}

void require_finite(double value, const char* shape, const char* quantity) {
  require(std::isfinite(static_cast<float>(value)), shape, quantity, value, "finite in single precision");
}

double angle(double phimax_rad, const char* shape) {
  require(phimax_rad > 0, shape, "phimax", phimax_rad, "above 0");
  constexpr double turn = Quadric{}.phi_max_rad;
  return phimax_rad >= turn * (1 - 1e-7) ? turn : phimax_rad;
}

// A quadrature of 5 points by Gauss and Legendre in each of 16 parts.
template <class F>
double integral(F&& f, double from, double to) {
  constexpr int parts = 16;
  constexpr double nodes[] = {0, 0.5384693101056831, 0.9061798459386640},
                   weights[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double half = (to - from) / (2 * parts);
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double middle = from + (2 * i + 1) * half;
    sum += weights[0] * f(middle);
    for (int k = 1; k < 3; ++k)
      sum += weights[k] * (f(middle - half * nodes[k]) + f(middle + half * nodes[k]));
  }
  return sum * half;
}

// Of the curve that turns, with its ends: ∂p/∂φ × ∂p/∂t is x·(cos φ, sin φ, 0) + y·z.
struct Profile {
  double from = 0, to = 0;
  Point2d (*at)(double t) = nullptr;
};

Profile profile_of(const Quadric& q) {
  switch (q.kind) {
    case QuadricKind::sphere:  // t from the pole −z
      return {std::acos(-q.low), std::acos(-q.high), [](double t) {
                return Point2d{std::sin(t) * std::sin(t), -std::sin(t) * std::cos(t)};
              }};
    case QuadricKind::cylinder:
      return {0, 1, [](double) { return Point2d{1, 0}; }};
    case QuadricKind::disk:
      return {q.low, 1, [](double t) { return Point2d{0, t}; }};
    case QuadricKind::cone:  // t from the apex
      return {0, 1, [](double t) { return Point2d{t, t}; }};
    case QuadricKind::paraboloid:
      return {std::sqrt(q.low), 1, [](double t) { return Point2d{2 * t * t, -t}; }};
    case QuadricKind::curve:  // no surface of revolution
      break;
  }
  return {};
}

bool keeps_turning(const Transform& t) {
  const auto axis = [&](std::size_t i) { return Vector3d{t.m[0][i], t.m[1][i], t.m[2][i]}; };
  const Vector3d x = axis(0), y = axis(1), z = axis(2);
  const double unit = dot(x, x), tolerance = 1e-12 * unit;
  return std::abs(dot(y, y) - unit) <= tolerance && std::abs(dot(x, y)) <= tolerance &&
         std::abs(dot(x, z)) <= tolerance && std::abs(dot(y, z)) <= tolerance;
}

}  // namespace

TriangleMesh mesh_of(const Quadric& quadric) {
  TriangleMesh mesh;
  mesh.quadric = quadric;
  return mesh;
}

double area_of(const Quadric& q, const Transform& to) {
  const Profile profile = profile_of(q);
  // A normal as long as its surface is large goes over by the cofactors.
  const auto strip = [&](double phi) {
    const double x = std::cos(phi), y = std::sin(phi);
    return integral(
        [&](double t) {
          const Point2d n = profile.at(t);
          return length(to_vector(transform_normal(to, {n.x * x, n.x * y, n.y})));
        },
        profile.from, profile.to);
  };
  return keeps_turning(to) ? q.phi_max_rad * strip(0) : integral(strip, 0, q.phi_max_rad);
}

SizedQuadric sphere(double radius, double zmin, double zmax, double phimax_rad) {
  require_size(radius, "sphere", "radius");
  require(!std::isnan(zmin) && !std::isnan(zmax), "sphere", "zmin or zmax", NAN, "a number");
  const double bottom = std::clamp(std::min(zmin, zmax), -radius, radius);
  const double top = std::clamp(std::max(zmin, zmax), -radius, radius);
  require(bottom < top, "sphere", "zmin", zmin, "another height than zmax within the sphere");
  return {{.kind = QuadricKind::sphere,
           .low = bottom / radius,
           .high = top / radius,
           .phi_max_rad = angle(phimax_rad, "sphere")},
          scale({radius, radius, radius})};
}

SizedQuadric disk(double height, double radius, double inner_radius, double phimax_rad) {
  require_size(radius, "disk", "radius");
  require_finite(height, "disk", "height");
  require(inner_radius >= 0 && inner_radius < radius, "disk", "inner radius", inner_radius,
          "at least 0 and less than the radius");
  return {{.kind = QuadricKind::disk, .low = inner_radius / radius, .phi_max_rad = angle(phimax_rad, "disk")},
          translate({0, 0, height}) * scale({radius, radius, radius})};
}

SizedQuadric cylinder(double radius, double zmin, double zmax, double phimax_rad) {
  require_size(radius, "cylinder", "radius");
  require_finite(zmin, "cylinder", "zmin");
  require_finite(zmax, "cylinder", "zmax");
  require(zmin != zmax, "cylinder", "zmin", zmin, "another height than zmax");
  const double bottom = std::min(zmin, zmax), height = std::abs(zmax - zmin);
  return {{.kind = QuadricKind::cylinder, .phi_max_rad = angle(phimax_rad, "cylinder")},
          translate({0, 0, bottom}) * scale({radius, radius, height})};
}

SizedQuadric cone(double radius, double height, double phimax_rad) {
  require_size(radius, "cone", "radius");
  require_size(height, "cone", "height");
  return {{.kind = QuadricKind::cone, .phi_max_rad = angle(phimax_rad, "cone")},
          scale({radius, radius, height})};
}

SizedQuadric paraboloid(double radius, double zmin, double zmax, double phimax_rad) {
  require_size(radius, "paraboloid", "radius");
  const double bottom = std::min(zmin, zmax), top = std::max(zmin, zmax);
  require_size(top, "paraboloid", "zmax");
  require(bottom >= 0 && bottom < top, "paraboloid", "zmin", bottom, "at least 0 and below zmax");
  return {
      {.kind = QuadricKind::paraboloid, .low = bottom / top, .phi_max_rad = angle(phimax_rad, "paraboloid")},
      scale({radius, radius, top})};
}

}  // namespace vitrail
