// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/spline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

// a + bt + ct² + dt³, 0 ≤ t ≤ 1.
struct Cubic {
  Point2d a, b, c, d;

  Point2d at(double t) const {
    return {a.x + t * (b.x + t * (c.x + t * d.x)), a.y + t * (b.y + t * (c.y + t * d.y))};
  }
  Point2d slope(double t) const {
    return {b.x + t * (2 * c.x + t * 3 * d.x), b.y + t * (2 * c.y + t * 3 * d.y)};
  }
  // Of the second derivative, which is linear.
  double greatest_bend() const {
    const auto size = [](double x, double y) { return std::sqrt(x * x + y * y); };
    return std::max(size(2 * c.x, 2 * c.y), size(2 * c.x + 6 * d.x, 2 * c.y + 6 * d.y));
  }
};

Point2d sum(std::array<double, 4> w, std::span<const Point2d> p) {
  Point2d s;
  for (std::size_t i = 0; i < p.size(); ++i) s = {s.x + w[i] * p[i].x, s.y + w[i] * p[i].y};
  return s;
}

std::vector<Cubic> segments(SplineKind kind, std::span<const Point2d> p) {
  std::vector<Cubic> made;
  switch (kind) {
    case SplineKind::linear:
      for (std::size_t i = 0; i + 1 < p.size(); ++i)
        made.push_back({p[i], sum({-1, 1}, p.subspan(i, 2)), {}, {}});
      break;
    case SplineKind::quadratic:  // the parabola through three points at t = −1, 0, 1
      for (std::size_t i = 0; i + 2 < p.size(); ++i) {
        const auto q = p.subspan(i, 3);
        made.push_back({q[1], sum({-0.5, 0, 0.5}, q), sum({0.5, -1, 0.5}, q), {}});
      }
      break;
    case SplineKind::cubic:
      for (std::size_t i = 0; i + 3 < p.size(); ++i) {
        const auto q = p.subspan(i, 4);
        made.push_back(
            {q[1], sum({-0.5, 0, 0.5, 0}, q), sum({1, -2.5, 2, -0.5}, q), sum({-0.5, 1.5, -1.5, 0.5}, q)});
      }
      break;
    case SplineKind::bezier:
      for (std::size_t i = 0; i + 3 < p.size(); i += 4) {
        const auto q = p.subspan(i, 4);
        made.push_back({q[0], sum({-3, 3, 0, 0}, q), sum({3, -6, 3, 0}, q), sum({-1, 3, -3, 1}, q)});
      }
      break;
  }
  return made;
}

Point2d unit2(Point2d v, Point2d otherwise) {
  const double size = std::sqrt(v.x * v.x + v.y * v.y),
               other = std::sqrt(otherwise.x * otherwise.x + otherwise.y * otherwise.y);
  if (size > 1e-9 * other && size > 0) return {v.x / size, v.y / size};
  return other > 0 ? Point2d{otherwise.x / other, otherwise.y / other} : Point2d{1, 0};
}

Point2d minus(Point2d a, Point2d b) { return {a.x - b.x, a.y - b.y}; }

// Adds the chords of a segment to those before it.
void append(PlaneCurve& curve, const Cubic& segment, double tolerance) {
  const double wanted = std::sqrt(segment.greatest_bend() / (8 * tolerance));
  const int count = std::clamp(static_cast<int>(std::ceil(std::min(wanted, 1e4))), 1, 4096);
  for (int i = 0; i < count; ++i) {
    const double t0 = static_cast<double>(i) / count, t1 = static_cast<double>(i + 1) / count;
    const Point2d from = segment.at(t0), to = segment.at(t1), chord = minus(to, from);
    if (chord == Point2d{}) continue;
    if (curve.points.empty()) curve.points.push_back({from, {}, {}});
    curve.points.back().leaving = unit2(segment.slope(t0), chord);
    curve.points.push_back({to, unit2(segment.slope(t1), chord), {}});
  }
}

bool same(Point2d a, Point2d b, double size) {
  return std::abs(a.x - b.x) <= 1e-6 * size && std::abs(a.y - b.y) <= 1e-6 * size;
}

void close(PlaneCurve& curve) {
  const CurvePoint last = curve.points.back();
  curve.points.pop_back();
  curve.points.front().arriving = last.arriving;
  curve.closed = true;
}

// How many points stand before the one where a contour begins.
std::size_t before(SplineKind kind) { return kind == SplineKind::quadratic || kind == SplineKind::cubic; }

}  // namespace

double greatest_edge(std::span<const Point2d> points) {
  if (points.empty()) return 0;
  Point2d low = points.front(), high = low;
  for (const Point2d p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) throw Error("a point of a spline is not finite");
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return std::max(high.x - low.x, high.y - low.y);
}

PlaneCurve plane_curve(SplineKind kind, std::span<const Point2d> points, double tolerance) {
  const double size = greatest_edge(points);
  const std::vector<Cubic> parts = segments(kind, points);
  if (parts.empty()) throw Error("a spline has too few points");
  PlaneCurve curve;
  for (const Cubic& part : parts) append(curve, part, tolerance);
  if (curve.points.size() < 2) throw Error("a spline has no length");
  if (curve.points.size() > 2 && same(curve.points.front().place, curve.points.back().place, size)) {
    close(curve);
  } else {
    curve.points.front().arriving = curve.points.front().leaving;
    curve.points.back().leaving = curve.points.back().arriving;
  }
  return curve;
}

std::vector<PlaneCurve> contours(SplineKind kind, std::span<const Point2d> points, double tolerance) {
  const double size = greatest_edge(points);
  std::vector<PlaneCurve> made;
  const std::size_t step = kind == SplineKind::bezier ? 4 : 1, lead = before(kind);
  std::size_t begin = 0;
  while (begin + lead + 2 < points.size()) {
    const Point2d first = points[begin + lead];
    std::size_t last = begin + lead + (step == 4 ? 3 : 1);
    while (last < points.size() && !same(points[last], first, size)) last += step;
    std::size_t end = last + 1 + (kind == SplineKind::cubic);
    end = std::min(end, points.size());
    PlaneCurve curve = plane_curve(kind, points.subspan(begin, end - begin), tolerance);
    if (!curve.closed) {
      const Point2d chord = minus(curve.points.front().place, curve.points.back().place);
      curve.points.front().arriving = curve.points.back().leaving = unit2(chord, {1, 0});
      curve.closed = true;
    }
    made.push_back(std::move(curve));
    begin = end;
  }
  if (made.empty()) throw Error("a prism has too few points");
  return made;
}

}  // namespace vitrail::solids
