// SPDX-License-Identifier: Apache-2.0
// A division of the sphere of directions that is as fine as samples are dense, and integrals over its cells.
#pragma once

#include <functional>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail::laws {

// Each hemisphere is mapped to a square without changing areas (Shirley & Chiu 1997), and that is halved
// until few samples are left in each cell: the integrand that the samples follow is smooth within a cell,
// however narrow its peaks.
class SphereCells {
 public:
  explicit SphereCells(const std::vector<Vector3d>& samples);

  std::size_t size() const { return boxes_.size(); }
  std::size_t cell_of(Vector3d direction) const;
  // ∫ f over each cell, in solid angle. Neighbours in the array are neighbours on the sphere.
  std::vector<double> integrate(const std::function<double(Vector3d)>& f) const;

 private:
  struct Box {
    double side, x0, x1, y0, y1;  // side: the sign of z
  };
  struct Node {  // axis −1: a leaf, `below` its cell
    int axis = -1;
    double at = 0;
    std::size_t below = 0, above = 0;
  };

  std::size_t build(const Box& box, std::vector<Point2d> points, int depth);
  double gauss(const std::function<double(Vector3d)>& f, const Box& box) const;
  double adaptive(const std::function<double(Vector3d)>& f, const Box& box, double coarse, int depth) const;

  std::vector<Node> nodes_;
  std::vector<Box> boxes_;
};

}  // namespace vitrail::laws
