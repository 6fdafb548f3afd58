// SPDX-License-Identifier: Apache-2.0
// Curves with a radius are kept segment by segment as what they are: QuadricKind::curve, a shape like
// quadrics.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/geometry/bounds.h"
#include "scene/geometry/transform.h"

namespace vitrail {

struct CurvePoint {
  Point3d position;
  double radius = 0;
};

// It is cubic, by its Bézier control points; radii are interpolated like positions.
using CurveSegment = std::array<CurvePoint, 4>;

inline CurvePoint mix(const CurvePoint& a, const CurvePoint& b, double t) {
  return {a.position + (b.position - a.position) * t, a.radius + (b.radius - a.radius) * t};
}
inline CurvePoint halfway(const CurvePoint& a, const CurvePoint& b) {
  return {a.position + (b.position - a.position) * 0.5, (a.radius + b.radius) * 0.5};
}
// Halves a Bézier curve (de Casteljau).
template <class Point>
void halve(const std::array<Point, 4>& p, std::array<Point, 4>& first, std::array<Point, 4>& second) {
  const Point ab = halfway(p[0], p[1]), bc = halfway(p[1], p[2]), cd = halfway(p[2], p[3]);
  const Point abc = halfway(ab, bc), bcd = halfway(bc, cd), middle = halfway(abc, bcd);
  first = {p[0], ab, abc, middle};
  second = {middle, bcd, cd, p[3]};
}

// They return the segments of a curve with these control points: none where they are too few for one.
std::vector<CurveSegment> linear_segments(std::span<const CurvePoint> points);             // n − 1
std::vector<CurveSegment> bspline_segments(std::span<const CurvePoint> points);            // n − 3, cubic
std::vector<CurveSegment> quadratic_bspline_segments(std::span<const CurvePoint> points);  // n − 2
std::vector<CurveSegment> bezier_segments(std::span<const CurvePoint> points);             // (n − 1) / 3
std::vector<CurveSegment> quadratic_bezier_segments(std::span<const CurvePoint> points);   // (n − 1) / 2

// It is one segment where it stands. Its surface is that of balls along it, cut off at either end by a plane.
//   cubic      a Bézier curve; the planes are perpendicular to it
//   straight   from the first point to the last; p₁ − p₀ and p₃ − p₂ are normal to the planes, and where they
//              are 0 there is none: that end is round
// A ray meets it from outside alone, and its front is outside, `mirrored` inside.
struct PlacedCurve {
  Point3d origin;                         // the first control point
  std::array<Vector3f, 3> to{};           // from there to the others
  std::array<float, 4> radius{};          // ≥ 0, at the control points
  float along_first = 0, along_last = 1;  // the parameter of the whole curve at its ends
  bool straight = false, mirrored = false;
};

PlacedCurve placed_curve(const CurveSegment& segment, double along_first, double along_last, bool straight);

// Returns all of a curve, as records. Straight segments that follow each other share a plane that halves the
// angle between them, and `round_ends` says whether the ends are round or open.
std::vector<PlacedCurve> placed_curves(std::span<const CurveSegment> segments, double along_first,
                                       double along_last, bool straight, bool round_ends);

// They pack a curve into a matrix's bytes, so that it goes where matrices go, and unpack it. A packed curve
// is no matrix, but its origin is where a matrix has its translation. Doubles made of finite floats are
// finite.
Transform packed(const PlacedCurve& curve);
PlacedCurve unpacked_curve(const double (&rows)[3][4]);
PlacedCurve unpacked_curve(const Transform& packed);
// Returns whether every number of it is finite and no radius is negative.
bool is_valid(const PlacedCurve& curve);

// Returns the curve taken through an affine transform. It is exact to floats where that is a similarity;
// radii take the root of the mean square of its columns.
PlacedCurve transformed(const Transform& t, const PlacedCurve& curve);
// Returns whether balls stay balls, but for 10⁻⁴.
bool is_similarity(const Transform& t);

Bounds3d bounds_of(const PlacedCurve& curve);
// Returns the curve by its control points again.
CurveSegment segment_of(const PlacedCurve& curve);

}  // namespace vitrail
