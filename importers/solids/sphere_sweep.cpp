// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include "importers/solids/implicit.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

struct Along {
  Point3d center;
  double radius;
};

// What a sphere covers whose centre and radius go from one end to the other in equal measure: its surface is
// a cone between two spheres.
class RoundCone {
 public:
  RoundCone(const Along& a, const Along& b) : from_(a.center), axis_(b.center - a.center), radius_(a.radius) {
    size_ = length(axis_);
    if (size_ > 0) axis_ = axis_ * (1 / size_);
    sine_ = size_ > 0 ? (a.radius - b.radius) / size_ : 0;
    if (std::abs(sine_) >= 1 || size_ == 0) {  // one covers the other
      if (b.radius > a.radius) from_ = b.center, radius_ = b.radius;
      size_ = sine_ = 0;
    }
    tangent_ = sine_ / std::sqrt(1 - sine_ * sine_);
  }

  double distance(const Point3d& p) const {
    const Vector3d v = p - from_;
    const double t = dot(v, axis_), across = std::sqrt(std::max(0.0, dot(v, v) - t * t));
    const double u = std::clamp(t - across * tangent_, 0.0, size_);
    return length(v - axis_ * u) - (radius_ - u * sine_);
  }

 private:
  Point3d from_;
  Vector3d axis_;
  double size_ = 0, radius_, sine_ = 0, tangent_ = 0;
};

// Cones one after the other, in runs that a sphere encloses.
class Runs {
 public:
  explicit Runs(const std::vector<Along>& knots) {
    for (std::size_t i = 1; i < knots.size(); ++i) {
      if (runs_.empty() || runs_.back().cones.size() == 8) runs_.push_back({});
      Run& run = runs_.back();
      run.cones.emplace_back(knots[i - 1], knots[i]);
      for (const Along& k : {knots[i - 1], knots[i]}) {
        const Vector3d r{k.radius, k.radius, k.radius};
        extend(run.bounds, k.center - r);
        extend(run.bounds, k.center + r);
      }
    }
    for (Run& run : runs_) {
      run.center = center(run.bounds);
      run.radius = length(extent(run.bounds)) / 2;
    }
  }

  double distance(const Point3d& p) const {
    double nearest = 1e300;
    for (const Run& run : runs_) {
      const double reach = nearest + run.radius;
      if (reach < 1e150 && (reach < 0 || dot(p - run.center, p - run.center) > reach * reach)) continue;
      for (const RoundCone& c : run.cones) nearest = std::min(nearest, c.distance(p));
    }
    return nearest;
  }

 private:
  struct Run {
    std::vector<RoundCone> cones;
    Bounds3d bounds;
    Point3d center;
    double radius = 0;
  };
  std::vector<Run> runs_;
};

// Of four knots, at 0 ≤ t ≤ 1.
Along at(SweepKind kind, const SweptSphere* knots, double t) {
  const double s = t * t, c = s * t;
  std::array<double, 4> w{};
  if (kind == SweepKind::cubic) {  // Catmull and Rom 1974
    w = {(-t + 2 * s - c) / 2, (2 - 5 * s + 3 * c) / 2, (t + 4 * s - 3 * c) / 2, (-s + c) / 2};
  } else {  // uniform B-spline
    w = {(1 - 3 * t + 3 * s - c) / 6, (4 - 6 * s + 3 * c) / 6, (1 + 3 * t + 3 * s - 3 * c) / 6, c / 6};
  }
  Along made{{}, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    made.center = made.center + (knots[i].center - Point3d{}) * w[i];
    made.radius += w[i] * knots[i].radius;
  }
  made.radius = std::max(made.radius, 0.0);
  return made;
}

std::vector<Along> knots_of(const SphereSweep& sweep) {
  std::vector<Along> made;
  const auto& spheres = sweep.spheres;
  if (sweep.kind == SweepKind::linear) {
    for (const SweptSphere& s : spheres) made.push_back({s.center, s.radius});
    return made;
  }
  constexpr int steps = 24;
  for (std::size_t i = 0; i + 3 < spheres.size(); ++i)
    for (int k = i == 0 ? 0 : 1; k <= steps; ++k)
      made.push_back(at(sweep.kind, &spheres[i], static_cast<double>(k) / steps));
  return made;
}

}  // namespace

Solid sphere_sweep(const SphereSweep& sweep, const Tessellation& tessellation) {
  for (const SweptSphere& s : sweep.spheres)
    if (!is_finite(s.center) || !std::isfinite(s.radius) || s.radius < 0)
      throw Error("a sphere of a sweep has no finite place or radius");
  const std::vector<Along> knots = knots_of(sweep);
  if (knots.size() < 2) throw Error("a sphere sweep has too few spheres");
  Bounds3d bounds;
  double smallest = 1e300, greatest = 0;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const Vector3d r{knots[i].radius, knots[i].radius, knots[i].radius};
    extend(bounds, knots[i].center - r);
    extend(bounds, knots[i].center + r);
    greatest = std::max(greatest, knots[i].radius);
    smallest = std::min(smallest, knots[i].radius);
  }
  if (!(greatest > 0)) throw Error("a sphere sweep has no radius");
  smallest = std::max(smallest, greatest / 8);  // a point at an end needs no finer cells
  const Vector3d size = extent(bounds);
  const double edge = std::max({size.x, size.y, size.z}), margin = 0.02 * edge;
  bounds.lower = bounds.lower - Vector3d{margin, margin, margin};
  bounds.upper = bounds.upper + Vector3d{margin, margin, margin};
  const auto runs = std::make_shared<Runs>(knots);
  return implicit({.field = [runs](const Point3d& p) { return runs->distance(p); },
                   .container = bounds,
                   .max_gradient = 1.001,
                   .cells = static_cast<int>(std::clamp(1.6 * edge / smallest, 32.0, 512.0))},
                  tessellation);
}

}  // namespace vitrail::solids
