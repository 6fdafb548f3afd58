// SPDX-License-Identifier: Apache-2.0
// trace() and inside() ask, while a scene is read, where rays meet triangles of meshes, in double precision.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "importers/solids/solid.h"
#include "scene/geometry/bounds.h"

namespace vitrail::pov {

// It has the points from + t · along.
struct Line {
  Point3d from;
  Vector3d along;
  Point3d at(double t) const { return from + along * t; }
};

// Returns whether the line meets the box at some t ≥ 0.
bool meets(const Bounds3d& box, const Line& line);

// It is a hierarchy of boxes, halved at the median of the longest side.
class TriangleTree {
 public:
  struct Triangle {
    std::array<Point3d, 3> corners;
    std::array<Vector3d, 3> normals;  // of the surface that it stands for
  };
  explicit TriangleTree(std::vector<Triangle> triangles);

  // Finds all hits with t > 0, in any order. `side` is dot(along, cross of the edges), whose sign says
  // whether the line enters or leaves.
  void hits(const Line& line, const std::function<void(double t, Vector3d normal, double side)>& hit) const;
  const Bounds3d& bounds() const { return bounds_; }

 private:
  struct Node {
    Bounds3d box;
    std::uint32_t first = 0,
                  count = 0;  // of triangles; count 0: `first` is the second child, behind the first
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  Bounds3d bounds_;
};

TriangleTree tree_of(const solids::Solid& solid);

}  // namespace vitrail::pov
