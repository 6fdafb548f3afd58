// SPDX-License-Identifier: Apache-2.0
// Cutting at axis-aligned interfaces, ghost-free: nothing is lost, doubled or moved.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bundle/domain_file.h"
#include "partitioner/flatten.h"

namespace vitrail {

// The interface where coordinate `axis` equals `split`.
struct Plane {
  int axis = 0;
  float split = 0;
};

// What lies in one cell of the kd-tree: triangles that no interface has cut, and pieces of those that one
// has. Ascending by id. Each triangle is here once at most.
struct CellContent {
  std::vector<std::uint32_t> whole;
  std::vector<Piece> pieces;
  std::vector<Point3d> piece_vertices;

  std::size_t size() const { return whole.size() + pieces.size(); }
  std::span<const Point3d> polygon(const Piece& p) const {
    return std::span(piece_vertices).subspan(p.first_vertex, p.vertex_count);
  }
};

// Extent along an axis.
struct Interval {
  double lower = 0, upper = 0;
};
Interval interval(const Triangle& triangle, int axis);
Interval interval(std::span<const Point3d> polygon, int axis);

// Which side of a plane something of this extent belongs to. What touches the plane from one side stays on
// that side; what lies in it goes below.
inline bool reaches_above(Interval i, float split) { return i.upper > split; }
inline bool reaches_below(Interval i, float split) { return i.lower < split || i.upper <= split; }

// Where the segment from `below` to `above` crosses the plane, in double. Always called in that direction, so
// whoever shares the edge gets the same bits; the coordinate on the axis is the split itself, the others stay
// within the segment's.
Point3d crossing(Point3d below, Point3d above, Plane plane);

// The parts below and above. What straddles is cut into convex polygons in its own winding; vertices in the
// plane belong to both sides as they are.
std::pair<CellContent, CellContent> cut(const CellContent& content, std::span<const Triangle> triangles,
                                        Plane plane);

}  // namespace vitrail
