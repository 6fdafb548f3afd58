// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vitrail {

namespace {

// Twice the signed area of a triangle in the plane.
double orientation(Point2d a, Point2d b, Point2d c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Twice the area vector of the polygon (Newell's method, about corner 0).
Vector3d area_vector(std::span<const Point3d> p) {
  Vector3d sum;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum = sum + cross(p[i] - p[0], p[i + 1] - p[0]);
  return sum;
}

bool fan_tiles(std::span<const Point3d> p, Vector3d normal) {
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    if (!(dot(cross(p[i] - p[0], p[i + 1] - p[0]), normal) > 0)) return false;
  }
  return true;
}

// Drops the axis along which the polygon is thinnest, keeping it counter-clockwise.
std::vector<Point2d> project(std::span<const Point3d> p, Vector3d normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  const int dropped = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
  int first = (dropped + 1) % 3, second = (dropped + 2) % 3;
  if (normal[dropped] < 0) std::swap(first, second);
  std::vector<Point2d> flat;
  flat.reserve(p.size());
  for (const Point3d& q : p) flat.push_back({q[first], q[second]});
  return flat;
}

// The polygon that is left, as a ring of corners.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Point2d> corners)
      : p_(std::move(corners)), next_(p_.size()), previous_(p_.size()), is_concave_(p_.size()) {
    std::iota(next_.begin(), next_.end(), 1u);
    next_.back() = 0;
    for (std::uint32_t i = 0; i < next_.size(); ++i) previous_[next_[i]] = i;
    for (std::uint32_t i = 0; i < next_.size(); ++i) {
      is_concave_[i] = area(i) <= 0;
      if (is_concave_[i]) concave_.push_back(i);
    }
    const auto [left, right] = std::ranges::minmax(p_, {}, &Point2d::x);
    const auto [bottom, top] = std::ranges::minmax(p_, {}, &Point2d::y);
    long_axis_ = right.x - left.x >= top.y - bottom.y ? &Point2d::x : &Point2d::y;
    std::ranges::sort(concave_, {}, [&](std::uint32_t i) { return p_[i].*long_axis_; });
  }

  void clip(std::vector<CornerTriple>& triangles) {
    std::uint32_t at = 0;
    for (std::size_t left = p_.size(); left > 3; --left) {
      const std::uint32_t ear = find_ear(at, left), before = previous_[ear], after = next_[ear];
      triangles.push_back({before, ear, after});
      next_[before] = after;
      previous_[after] = before;
      is_concave_[ear] = false;
      // Corners only ever become more convex.
      for (const std::uint32_t i : {before, after}) is_concave_[i] = is_concave_[i] && area(i) <= 0;
      // Going on behind the next corner cuts ears all around instead of a fan of slivers.
      at = next_[after];
    }
    triangles.push_back({previous_[at], at, next_[at]});
  }

 private:
  double area(std::uint32_t i) const { return orientation(p_[previous_[i]], p_[i], p_[next_[i]]); }

  // A convex corner whose triangle holds no other corner. None exists where the polygon crosses itself or has
  // no area left: then any convex corner, else any.
  std::uint32_t find_ear(std::uint32_t start, std::size_t left) const {
    std::uint32_t at = start, fallback = start;
    for (std::size_t i = 0; i < left; ++i, at = next_[at]) {
      if (area(at) <= 0) continue;
      if (is_empty(at)) return at;
      fallback = at;
    }
    return fallback;
  }

  // A corner at the very place of one of the triangle's is outside: polygons with a bridge to a hole have
  // such.
  bool is_empty(std::uint32_t ear) const {
    const Point2d a = p_[previous_[ear]], b = p_[ear], c = p_[next_[ear]];
    const auto [low, high] = std::minmax({a.*long_axis_, b.*long_axis_, c.*long_axis_});
    auto at = std::ranges::lower_bound(concave_, low, {}, [&](std::uint32_t i) { return p_[i].*long_axis_; });
    for (; at != concave_.end() && p_[*at].*long_axis_ <= high; ++at) {
      const Point2d q = p_[*at];
      if (!is_concave_[*at] || q == a || q == b || q == c) continue;
      if (orientation(a, b, q) >= 0 && orientation(b, c, q) >= 0 && orientation(c, a, q) >= 0) return false;
    }
    return true;
  }

  std::vector<Point2d> p_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<bool> is_concave_;        // not strictly convex, and not clipped yet
  std::vector<std::uint32_t> concave_;  // those which began so, along the longer axis
  double Point2d::*long_axis_ = nullptr;
};

}  // namespace

void triangulate_polygon(std::span<const Point3d> corners, std::vector<CornerTriple>& triangles) {
  if (corners.size() > 3) {
    const Vector3d normal = area_vector(corners);
    if (dot(normal, normal) > 0 && !fan_tiles(corners, normal)) {
      EarClipper(project(corners, normal)).clip(triangles);
      return;
    }
  }
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.push_back({0, i, i + 1});
}

}  // namespace vitrail
