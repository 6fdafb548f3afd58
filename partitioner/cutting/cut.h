// SPDX-License-Identifier: Apache-2.0
// Triangles are cut at axis-aligned interfaces, ghost-free: nothing is lost, doubled or moved.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bundle/domain_file.h"
#include "bundle/manifest.h"
#include "partitioner/placing/placement.h"

namespace vitrail {

// A Plane is the interface where coordinate `axis` equals `split`.
struct Plane {
  int axis = 0;
  float split = 0;
};

// They are placed triangles with their global ids, ascending. Elsewhere here, a triangle's
// number is its index in these.
struct NumberedTriangles : PlacedTriangles {
  std::vector<std::uint32_t> ids;
};

// A CellContent has the triangles in one cell of the kd-tree: those that no interface has cut, and pieces of
// cut ones. They ascend. Each triangle is here once at most.
struct CellContent {
  std::vector<std::uint32_t> whole;
  std::vector<Piece> pieces;
  std::vector<Point3d> piece_vertices;

  std::size_t size() const { return whole.size() + pieces.size(); }
  std::span<const Point3d> polygon(const Piece& p) const {
    return std::span(piece_vertices).subspan(p.first_vertex, p.vertex_count);
  }
  void add(std::uint32_t triangle, std::span<const Point3d> polygon);
  // Appends what comes behind in the order of triangles, whose indices there are less by `first`.
  void append(const CellContent& next, std::uint32_t first = 0);
};

// An AxisExtent is an extent along an axis.
struct AxisExtent {
  double lower = 0, upper = 0;
};
AxisExtent interval(const Triangle& triangle, int axis);
AxisExtent interval(std::span<const Point3d> polygon, int axis);

// They return which side of a plane something of this extent belongs to. What touches the plane from one side
// stays on that side; what lies in it goes below.
inline bool reaches_above(AxisExtent i, float split) { return i.upper > split; }
inline bool reaches_below(AxisExtent i, float split) { return i.lower < split || i.upper <= split; }

// Returns where the segment from `below` to `above` crosses the plane, in double. It is always called in that
// direction, so that all who share the edge get the same bits. The coordinate on the axis is the split
// itself, the others stay within the segment's.
Point3d crossing(Point3d below, Point3d above, Plane plane);

// Returns the convex parts of a convex polygon that reaches below and above, in its own winding. A vertex in
// the plane belongs to both as it is. Where rounding has moved several in a row there, the edges between them
// belong to the part below, so that the two parts do not overlap.
void split_polygon(std::span<const Point3d> polygon, Plane plane, std::vector<Point3d>& below,
                   std::vector<Point3d>& above);

// Sends triangles [begin, end) of a cell down a kd-tree whose leaf i is `leaves[i]`. A child is the index of
// a node, or KdNode::leaf_bit | leaf; without nodes there is one leaf. Only the pieces of `cut_before` count:
// what the cell has of its cut triangles.
void route(std::span<const Triangle> triangles, std::uint32_t begin, std::uint32_t end,
           const CellContent& cut_before, std::span<const KdNode> nodes, std::span<CellContent> leaves);

}  // namespace vitrail
