// SPDX-License-Identifier: Apache-2.0
// The plane curves of prisms and lathes, as POV-Ray lists their points.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail::solids {

enum class SplineKind {
  linear,     // through all points
  quadratic,  // through all points but the first, which gives the slope of the second
  cubic,      // through all but the first and the last (Catmull and Rom 1974)
  bezier,     // four points a segment
};

// A point of a curve, with the directions in which it arrives there and leaves: equal where it is smooth.
struct CurvePoint {
  Point2d place;
  Vector3d arriving, leaving;  // unit vectors; z is 0
};

struct PlaneCurve {
  std::vector<CurvePoint> points;  // of a closed curve the first is not repeated
  bool closed = false;
};

// Chords are at most `tolerance` from the curve. Throws Error where there are too few points.
PlaneCurve plane_curve(SplineKind kind, std::span<const Point2d> points, double tolerance);

// The contours of a prism: one ends where its first point (of quadratic and cubic splines, its second) comes
// again. Throws Error where one does not end.
std::vector<PlaneCurve> contours(SplineKind kind, std::span<const Point2d> points, double tolerance);

// Whether a set of contours encloses a point: `even_odd` counts crossings, `non_zero` turns.
enum class FillRule { even_odd, non_zero };

}  // namespace vitrail::solids
