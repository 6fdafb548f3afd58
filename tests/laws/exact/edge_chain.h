// SPDX-License-Identifier: Apache-2.0
// Sums of directed edges: an edge and its reverse cancel. What is left of a set of polygons is its boundary.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail::test {

struct DirectedEdge {
  Point3d from, to;
};

class EdgeChain {
 public:
  // Adds `times` the edge; vertices are the same only where their bits are. Edges without length count
  // nothing.
  void add(Point3d from, Point3d to, int times = 1);
  void add_polygon(std::span<const Point3d> polygon, int times = 1);

  // Each as often as it is left.
  std::vector<DirectedEdge> edges() const;

  // The same chain with every edge split at those vertices of the chain that lie on it, within `tolerance`,
  // and with vertices closer than a tenth of that made one: cancels collinear edges that are divided in
  // different ways.
  EdgeChain refined(double tolerance) const;

 private:
  using Bits = std::array<std::uint64_t, 3>;
  std::map<std::array<Bits, 2>, int>
      count_;  // of edges from the lesser vertex to the greater, negative if reversed
};

// Distance of a point from a segment.
double distance(Point3d p, const DirectedEdge& e);

}  // namespace vitrail::test
