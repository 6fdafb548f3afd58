// SPDX-License-Identifier: Apache-2.0
// These functions cut a segment of a curve into parts.
#pragma once

#include <algorithm>

#include "scene/shapes/curve.h"

namespace vitrail {

// It is a control point, or a ball on the curve.
struct CurveBall {
  Vector3d at;
  double radius;
};

inline CurveBall halfway(const CurveBall& a, const CurveBall& b) {
  return {(a.at + b.at) * 0.5, (a.radius + b.radius) * 0.5};
}

using CubicPart = std::array<CurveBall, 4>;  // by its Bézier control points

inline constexpr int most_halvings = 6;

// Returns the square of the greatest distance of a cubic from its chord (Wang 1984: ¾ of the greatest second
// difference). It falls with the fourth power of the number of parts.
inline double squared_chord_error(const PlacedCurve& c) {
  const Vector3d p1 = cast<double>(c.to[0]), p2 = cast<double>(c.to[1]), p3 = cast<double>(c.to[2]);
  const Vector3d bend0 = p2 - p1 * 2.0, bend1 = p3 - p2 * 2.0 + p1;
  return 0.5625 * std::max(dot(bend0, bend0), dot(bend1, bend1));
}

// Returns the halvings that bring chords within an eighth of the greatest radius of the curve.
inline int halvings(const PlacedCurve& c, double greatest_radius) {
  if (c.straight) return 0;
  const double off = squared_chord_error(c);
  double within = greatest_radius * greatest_radius / 64;
  int k = 0;
  for (; k < most_halvings && off > within; ++k) within *= 16;
  return k;
}

inline double greatest_radius(const PlacedCurve& c) { return double{*std::ranges::max_element(c.radius)}; }

// They return the normals of the planes that cut off the curve's ends; 0 where an end is round. The first
// plane's normal points into the curve, the last plane's out of it.
inline Vector3d first_plane(const PlacedCurve& c) {
  for (const Vector3f& to : c.to)
    if (c.straight || !(to == Vector3f{})) return cast<double>(to);
  return {};
}
inline Vector3d last_plane(const PlacedCurve& c) {
  const Vector3d end = cast<double>(c.to[2]), from[3] = {cast<double>(c.to[1]), cast<double>(c.to[0]), {}};
  for (const Vector3d& p : from)
    if (c.straight || !(p == end)) return end - p;
  return {};
}

}  // namespace vitrail
