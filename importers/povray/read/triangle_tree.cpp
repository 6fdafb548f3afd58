// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/triangle_tree.h"

#include <algorithm>
#include <cmath>

namespace vitrail::pov {

namespace {

Point3d middle(const TriangleTree::Triangle& t) {
  return Point3d{} +
         ((t.corners[0] - Point3d{}) + (t.corners[1] - Point3d{}) + (t.corners[2] - Point3d{})) * (1.0 / 3);
}

}  // namespace

bool meets(const Bounds3d& box, const Line& line) {
  double near = 0, far = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double from = line.from[axis], along = line.along[axis];
    // A little wider than the box: triangles may lie in its sides.
    const double slack = 1e-9 * (1 + std::abs(box.lower[axis]) + std::abs(box.upper[axis]));
    const double low = box.lower[axis] - slack - from, high = box.upper[axis] + slack - from;
    if (along == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / along, b = high / along;
    near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  for (const Triangle& t : triangles_)
    for (const Point3d& p : t.corners) extend(bounds_, p);
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

std::uint32_t TriangleTree::build(std::uint32_t first, std::uint32_t count) {
  const auto own = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, first, count});
  Bounds3d box, middles;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const Point3d& p : triangles_[i].corners) extend(box, p);
    extend(middles, middle(triangles_[i]));
  }
  nodes_[own].box = box;
  constexpr std::uint32_t leaf = 4;
  if (count <= leaf) return own;
  const Vector3d size = extent(middles);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [axis](const Triangle& a, const Triangle& b) {
    return middle(a)[axis] < middle(b)[axis];
  });
  build(first, count / 2);
  const std::uint32_t second = build(first + count / 2, count - count / 2);
  nodes_[own].first = second, nodes_[own].count = 0;
  return own;
}

// By barycentric coordinates (Möller and Trumbore 1997).
void TriangleTree::hits(const Line& line,
                        const std::function<void(double t, Vector3d normal, double side)>& hit) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> open;
  std::size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const std::uint32_t index = open[--count];
    const Node& node = nodes_[index];
    if (!meets(node.box, line)) continue;
    if (node.count == 0) {
      open[count++] = node.first;
      open[count++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto& [p, n] = triangles_[i];
      const Vector3d e1 = p[1] - p[0], e2 = p[2] - p[0], across = cross(line.along, e2);
      const double area = dot(e1, across);
      if (area == 0) continue;
      const Vector3d d = line.from - p[0];
      const double v = dot(d, across) / area;
      const Vector3d turned = cross(d, e1);
      const double w = dot(line.along, turned) / area;
      if (v < 0 || w < 0 || v + w > 1) continue;
      const double t = dot(e2, turned) / area;
      if (t > 0) hit(t, n[0] * (1 - v - w) + n[1] * v + n[2] * w, -area);
    }
  }
}

TriangleTree tree_of(const solids::Solid& solid) {
  std::vector<TriangleTree::Triangle> triangles;
  triangles.reserve(solid.triangles.size());
  for (std::size_t i = 0; i < solid.triangles.size(); ++i) {
    TriangleTree::Triangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      t.corners[k] = solid.positions[solid.triangles[i][k]];
      t.normals[k] = to_vector(cast<double>(solid.normals[i][k]));
    }
    triangles.push_back(t);
  }
  return TriangleTree(std::move(triangles));
}

}  // namespace vitrail::pov
