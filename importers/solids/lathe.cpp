// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "importers/solids/revolution.h"
#include "importers/solids/sweeps.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

// Of chords that come back, or that begin and end on the axis: positive where they run counter-clockwise.
double enclosed_area(std::span<const MeridianChord> chords) {
  double area = 0;
  for (const MeridianChord& c : chords) area += c.from.x * c.to.y - c.to.x * c.from.y;
  return area / 2;
}

void turn_round(std::vector<MeridianChord>& chords) {
  std::ranges::reverse(chords);
  for (MeridianChord& c : chords) {
    std::swap(c.from, c.to);
    std::swap(c.normal_from, c.normal_to);
    c.normal_from = {-c.normal_from.x, -c.normal_from.y};
    c.normal_to = {-c.normal_to.x, -c.normal_to.y};
  }
}

Solid turned(std::vector<MeridianChord> chords, double tolerance) {
  if (enclosed_area(chords) < 0) turn_round(chords);
  double widest = 0;
  for (const MeridianChord& c : chords) widest = std::max({widest, c.from.x, c.to.x});
  return revolve(chords, circle_chords(widest, tolerance));
}

// POV-Ray's curve for squares of radii: a cubic of y through (y, r²) whose slopes are those of the points to
// either side.
class SquaredRadius {
 public:
  SquaredRadius(Point2d before, Point2d from, Point2d to, Point2d after) : low_(from.y), high_(to.y) {
    const double h = high_ - low_;
    const double slope_from = 2 * from.x * (to.x - before.x) / (to.y - before.y);
    const double slope_to = 2 * to.x * (after.x - from.x) / (after.y - from.y);
    const double rise = (to.x * to.x - from.x * from.x) / h;
    a_ = from.x * from.x;
    b_ = slope_from;
    c_ = (3 * rise - 2 * slope_from - slope_to) / h;
    d_ = (slope_from + slope_to - 2 * rise) / (h * h);
  }

  Point2d at(double t) const {
    const double y = (high_ - low_) * t, square = a_ + y * (b_ + y * (c_ + y * d_));
    return {square > 0 ? std::sqrt(square) : 0, low_ + y};
  }
  Point2d normal(double t) const {
    const double y = (high_ - low_) * t, slope = b_ + y * (2 * c_ + y * 3 * d_);
    const double r = 2 * at(t).x, size = std::sqrt(r * r + slope * slope);
    return size > 0 ? Point2d{r / size, -slope / size} : Point2d{1, 0};
  }

  // Chords whose middles are near enough; at most 2¹⁰.
  void append_chords(std::vector<MeridianChord>& chords, double tolerance, double from, double to,
                     int depth) const {
    const Point2d a = at(from), b = at(to), middle = at((from + to) / 2);
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double off = std::abs((middle.x - a.x) * dy - (middle.y - a.y) * dx) / std::sqrt(dx * dx + dy * dy);
    if (depth < 2 || (off > tolerance && depth < 10)) {
      append_chords(chords, tolerance, from, (from + to) / 2, depth + 1);
      append_chords(chords, tolerance, (from + to) / 2, to, depth + 1);
    } else {
      chords.push_back({a, b, normal(from), normal(to)});
    }
  }

 private:
  double low_, high_, a_, b_, c_, d_;
};

}  // namespace

Solid lathe(const Lathe& lathe, const Tessellation& tessellation) {
  double widest = 0;
  for (const Point2d p : lathe.points) widest = std::max(widest, p.x);
  const double edge = std::max(greatest_edge(lathe.points), 2 * widest);
  const double tolerance = tessellation.deviation * edge / 2;
  const PlaneCurve curve = plane_curve(lathe.spline, lathe.points, tolerance);
  const auto place = [&](const CurvePoint& p) {
    return Point2d{p.place.x > 1e-9 * edge ? p.place.x : 0, p.place.y};
  };
  const auto right = [](Point2d tangent) { return Point2d{tangent.y, -tangent.x}; };
  std::vector<MeridianChord> chords;
  const Point2d begin = place(curve.points.front()), end = place(curve.points.back());
  if (!curve.closed && begin.x > 0) append_line(chords, {0, begin.y}, begin, unseen);
  const std::size_t count = curve.points.size();
  for (std::size_t i = 0; i + !curve.closed < count; ++i) {
    const CurvePoint &from = curve.points[i], &to = curve.points[(i + 1) % count];
    chords.push_back({place(from), place(to), right(from.leaving), right(to.arriving)});
  }
  if (!curve.closed && end.x > 0) append_line(chords, end, {0, end.y}, unseen);
  if (!(widest > 0)) throw Error("a lathe has no radius");
  return turned(std::move(chords), tolerance);
}

Solid surface_of_revolution(const SurfaceOfRevolution& sor, const Tessellation& tessellation) {
  const auto& points = sor.points;
  if (points.size() < 4) throw Error("a surface of revolution has fewer than four points");
  greatest_edge(points);  // all are finite
  double widest = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    widest = std::max(widest, points[i].x);
    if (points[i].x < 0) throw Error("a surface of revolution has a negative radius");
    if (i + 2 < points.size() && !(points[i + 1].y > points[i].y))
      throw Error("the heights of a surface of revolution do not ascend");
  }
  const double bottom = points[1].y, top = points[points.size() - 2].y;
  const double tolerance = tessellation.deviation * std::max(top - bottom, 2 * widest) / 2;
  std::vector<MeridianChord> chords;
  for (std::size_t i = 1; i + 2 < points.size(); ++i) {
    if (points[i - 1].y == points[i + 1].y || points[i].y == points[i + 2].y)
      throw Error("the heights of a surface of revolution do not ascend");
    SquaredRadius(points[i - 1], points[i], points[i + 1], points[i + 2])
        .append_chords(chords, tolerance, 0, 1, 0);
  }
  const std::uint32_t cap = sor.open ? unseen : 0;
  for (std::size_t i = 1; i < chords.size(); ++i) chords[i].from = chords[i - 1].to;
  const Point2d first = chords.front().from, last = chords.back().to;
  std::vector<MeridianChord> all;
  if (first.x > 0) append_line(all, {0, first.y}, first, cap);
  all.insert(all.end(), chords.begin(), chords.end());
  if (last.x > 0) append_line(all, last, {0, last.y}, cap);
  if (!(widest > 0)) throw Error("a surface of revolution has no radius");
  return turned(std::move(all), tolerance);
}

}  // namespace vitrail::solids
