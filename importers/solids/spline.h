// SPDX-License-Identifier: Apache-2.0
// Prisms and lathes have these plane curves, as POV-Ray lists their points.
#pragma once

#include <span>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail::solids {

enum class SplineKind {
  linear,     // through all points
  quadratic,  // through all points but the first, which gives the slope of the second
  cubic,      // through all but the first and the last (Catmull and Rom 1974)
  bezier,     // four points a segment
};

// It is a point of a curve, with the unit vectors along which the curve arrives there and leaves. They are
// equal where it is smooth.
struct CurvePoint {
  Point2d place;
  Point2d arriving, leaving;
};

struct PlaneCurve {
  std::vector<CurvePoint> points;  // of a closed curve the first is not repeated
  bool closed = false;
};

// Chords are at most `tolerance` from the curve, which is closed if it ends where it begins. Throws Error
// where points are too few or not finite.
PlaneCurve plane_curve(SplineKind kind, std::span<const Point2d> points, double tolerance);

// Returns the contours of a prism: one ends where its first point (of quadratic and cubic splines, its
// second) comes again. The last is closed by a line if it does not. Throws Error as `plane_curve` does.
std::vector<PlaneCurve> contours(SplineKind kind, std::span<const Point2d> points, double tolerance);

// Returns the greatest edge of the points' box, by which a tolerance is taken.
double greatest_edge(std::span<const Point2d> points);

}  // namespace vitrail::solids
