// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/triangle_overlaps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vitrail {

namespace {

using Flat = std::vector<Point2d>;

double cross2(Point2d a, Point2d b, Point2d c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double area_of(const Flat& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += cross2(polygon[0], polygon[i - 1], polygon[i]);
  return twice / 2;
}

// Without the axis along which the plane faces most; counter-clockwise.
Flat flattened(const FlatTriangle& triangle, int axis) {
  Flat flat;
  for (const Point3d& p : triangle.p)
    flat.push_back(axis == 0 ? Point2d{p.y, p.z} : axis == 1 ? Point2d{p.z, p.x} : Point2d{p.x, p.y});
  if (area_of(flat) < 0) std::swap(flat[1], flat[2]);
  return flat;
}

// What of a polygon is left of the line from a to b.
Flat clipped(const Flat& polygon, Point2d a, Point2d b) {
  Flat kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2d p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double at_p = cross2(a, b, p), at_q = cross2(a, b, q);
    if (at_p >= 0) kept.push_back(p);
    if ((at_p < 0) != (at_q < 0)) {
      const double t = at_p / (at_p - at_q);
      kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return kept;
}

double reach_of(const FlatTriangle& t) {
  double reach = 0;
  for (const Point3d& p : t.p) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return reach;
}

bool in_one_plane(const FlatTriangle& a, const FlatTriangle& b) {
  const FlatTriangle &large = a.area >= b.area ? a : b, &small = a.area >= b.area ? b : a;
  const double off = 4e-7 * std::max(reach_of(a), reach_of(b));
  if (std::abs(dot(a.normal, b.normal)) < 0.999) return false;
  return std::ranges::all_of(
      small.p, [&](const Point3d& p) { return std::abs(dot(large.normal, p - large.p[0])) <= off; });
}

double common_area(const FlatTriangle& a, const FlatTriangle& b) {
  const Vector3d n{std::abs(a.normal.x), std::abs(a.normal.y), std::abs(a.normal.z)};
  const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  const Flat window = flattened(b, axis);
  Flat rest = flattened(a, axis);
  for (std::size_t i = 0; i < 3; ++i) rest = clipped(rest, window[i], window[(i + 1) % 3]);
  return rest.size() < 3 ? 0 : area_of(rest) / (axis == 0 ? n.x : axis == 1 ? n.y : n.z);
}

Bounds3d box_of(const FlatTriangle& t) {
  Bounds3d box;
  for (const Point3d& p : t.p) extend(box, p);
  return box;
}

bool boxes_meet(const Bounds3d& a, const Bounds3d& b, int axis) {
  const auto margin = [&](int i) { return 1e-6 * std::max(std::abs(a.upper[i]), std::abs(a.lower[i])); };
  return a.lower[axis] <= b.upper[axis] + margin(axis) && b.lower[axis] <= a.upper[axis] + margin(axis);
}

}  // namespace

FlatTriangle flat_triangle(const std::array<Point3d, 3>& p) {
  const Vector3d n = cross(p[1] - p[0], p[2] - p[0]);
  FlatTriangle flat{p, {}, length(n) / 2};
  if (flat.area > 0) flat.normal = normalize(n);
  return flat;
}

// A sweep along the axis on which they are spread most.
std::vector<Overlap> overlaps_of(const std::vector<FlatTriangle>& triangles, bool& complete) {
  Bounds3d all;
  for (const FlatTriangle& t : triangles) extend(all, box_of(t));
  const Vector3d size = extent(all);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto lower = [&](const FlatTriangle& t) {
    return std::min({t.p[0][axis], t.p[1][axis], t.p[2][axis]});
  };
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair{lower(triangles[i]), i}; });
  std::vector<Overlap> overlaps;
  std::uint64_t left = 1u << 30;  // a few seconds
  for (std::size_t i = 0; i < order.size(); ++i) {
    const FlatTriangle& a = triangles[order[i]];
    const Bounds3d a_box = box_of(a);
    for (std::size_t k = i + 1; k < order.size() && left > 0; ++k, --left) {
      const FlatTriangle& b = triangles[order[k]];
      const Bounds3d b_box = box_of(b);
      if (!boxes_meet(a_box, b_box, axis)) break;
      if (!boxes_meet(a_box, b_box, (axis + 1) % 3) || !boxes_meet(a_box, b_box, (axis + 2) % 3)) continue;
      if (!in_one_plane(a, b)) continue;
      const double area = common_area(a, b);
      if (area > 1e-6 * std::min(a.area, b.area))
        overlaps.push_back({std::min(order[i], order[k]), std::max(order[i], order[k]), area});
    }
  }
  complete = left > 0;
  return overlaps;
}

}  // namespace vitrail
