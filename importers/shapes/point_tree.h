// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail {

// Returns twice the signed area of a triangle in the plane.
inline double orientation(Point2d a, Point2d b, Point2d c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// It holds points in the plane, of which some are asked for by triangle and removed one by one. It is a
// kd-tree whose nodes know their bounds and how many of their points are left.
class PointTree {
 public:
  // Takes the points of `indices`. `points` outlive the tree.
  PointTree(std::span<const Point2d> points, std::vector<std::uint32_t> indices);

  // Removes a point that is in the tree, in O(depth).
  void remove(std::uint32_t index);

  // Returns a point in the closed counter-clockwise triangle, but at none of its corners. It takes O(√n) for
  // slender triangles.
  std::optional<std::uint32_t> find_within(Point2d a, Point2d b, Point2d c) const;

 private:
  struct Node {
    Point2d lower, upper;
    std::uint32_t begin, end;  // of indices_
    std::uint32_t parent;
    std::uint32_t left;  // the right one follows it; 0 in leaves
    std::uint32_t alive;
  };

  void split(std::uint32_t node);

  std::span<const Point2d> points_;
  std::vector<std::uint32_t> indices_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_;  // of each point; `removed` for those that are not there
};

}  // namespace vitrail
