// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/pattern_warps.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/pi.h"
#include "scene/geometry/transform.h"
#include "scene/models/pattern_noise.h"

namespace vitrail::pov {

namespace {

Point3d shaken(Point3d p, Vector3d amount, int octaves, double lambda, double omega) {
  if (amount == Vector3d{}) return p;
  const Vector3d way = vector_turbulence(p, {std::clamp(octaves, 1, 10), lambda, omega});
  return {p.x + amount.x * way.x, p.y + amount.y * way.y, p.z + amount.z * way.z};
}

// Towards p + (1 − d/r)^falloff · strength · (p − c), at a distance d < r from the centre c.
Point3d pulled(const Warp& warp, Point3d p) {
  const Vector3d from_center = p - warp.center;
  const double distance = length(from_center);
  if (!(distance < warp.radius)) return p;
  const double pull = warp.strength * std::pow(1 - distance / warp.radius, warp.falloff);
  return p + from_center * (warp.inverse ? -pull : pull);
}

// Of tiles with an odd number, mirrored where `flip` says so; each tile is moved on by `offset`.
Point3d repeated(const Warp& warp, Point3d p) {
  for (int axis = 0; axis < 3; ++axis) {
    const double size = warp.amount[axis];
    if (!(std::abs(size) > 0)) continue;
    const double tile = std::floor(p[axis] / size);
    p[axis] -= tile * size;
    const bool odd = std::fmod(tile, 2) != 0;
    for (int i = 0; i < 3; ++i)
      if (odd && warp.flip[i] != 0) p[i] = (i == axis ? size : 0) - p[i];
    p = p + warp.offset * tile;
  }
  return p;
}

// What is around the y axis, flat: the turn and what is along the axis become x and y, the distance z.
// With dist_exp 0 the pattern is as large at every distance.
Point3d rolled(const Warp& warp, Point3d p) {
  const double across = std::hypot(p.x, p.z);
  double turn = std::atan2(p.z, p.x) / (2 * pi);
  if (turn < 0) turn += 1;
  const auto scaled = [&](double v, double distance) {
    return warp.dist_exp == 0 ? v : v * std::pow(distance, warp.dist_exp);
  };
  switch (warp.kind) {
    case Warp::Kind::cylindrical:
      return {scaled(turn, across), p.y, across};
    case Warp::Kind::spherical: {
      const double distance = length(p - Point3d{});
      return {scaled(turn, distance), scaled(0.5 + std::atan2(p.y, across) / pi, distance), distance};
    }
    default: {
      const double beside = across - warp.major_radius, distance = std::hypot(beside, p.y);
      return {scaled(turn, distance), scaled(0.5 + std::atan2(p.y, beside) / (2 * pi), distance), distance};
    }
  }
}

// `orientation`: the axis of the pattern that takes the place of its z.
Point3d oriented(const Warp& warp, Point3d p) {
  if (std::abs(warp.orientation.x) > 0.5) return {p.z, p.y, -p.x};
  if (std::abs(warp.orientation.y) > 0.5) return {p.x, -p.z, p.y};
  return p;
}

}  // namespace

Point3d warped(const Warp& warp, Point3d p) {
  switch (warp.kind) {
    case Warp::Kind::turbulence:
      return shaken(p, warp.amount, warp.octaves, warp.lambda, warp.omega);
    case Warp::Kind::transform:
      return is_invertible(warp.transform) ? transform_point(inverse(warp.transform), p) : p;
    case Warp::Kind::repeat:
      return repeated(warp, p);
    case Warp::Kind::black_hole:
      return pulled(warp, p);
    case Warp::Kind::planar:
      return oriented(warp, {p.x, p.y, warp.distance});
    case Warp::Kind::cylindrical:
    case Warp::Kind::spherical:
    case Warp::Kind::toroidal:
      return oriented(warp, rolled(warp, p));
  }
  return p;
}

Point3d turbulent(const Pattern& pattern, Point3d p) {
  return shaken(p, pattern.turbulence, pattern.octaves, pattern.lambda, pattern.omega);
}

}  // namespace vitrail::pov
