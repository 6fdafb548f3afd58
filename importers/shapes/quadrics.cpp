// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/quadrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/diagnostics.h"

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

}  // namespace

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
