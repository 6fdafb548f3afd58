// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cut.h"

#include <algorithm>

namespace vitrail {

namespace {

// Appends polygons to one side, pieces in ascending order of their triangles.
struct PieceBuilder {
  CellContent& out;
  void begin(std::uint32_t triangle) {
    out.pieces.push_back({triangle, static_cast<std::uint32_t>(out.piece_vertices.size()), 0});
  }
  void add(Point3d p) {
    out.piece_vertices.push_back(p);
    ++out.pieces.back().vertex_count;
  }
};

void cut_polygon(std::uint32_t triangle, std::span<const Point3d> polygon, Plane plane, CellContent& below,
                 CellContent& above) {
  PieceBuilder low{below}, high{above};
  low.begin(triangle);
  high.begin(triangle);
  const double c = plane.split;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3d p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double x = p[plane.axis], y = q[plane.axis];
    if (x <= c) low.add(p);
    if (x >= c) high.add(p);
    if ((x < c && y > c) || (x > c && y < c)) {
      const Point3d between = x < c ? crossing(p, q, plane) : crossing(q, p, plane);
      low.add(between);
      high.add(between);
    }
  }
}

void copy_piece(const CellContent& from, const Piece& piece, CellContent& to) {
  PieceBuilder builder{to};
  builder.begin(piece.triangle);
  for (const Point3d& p : from.polygon(piece)) builder.add(p);
}

// Pieces of triangles first cut here stand behind the older ones: brings both into one order.
void sort_pieces(CellContent& content) {
  std::sort(content.pieces.begin(), content.pieces.end(),
            [](const Piece& a, const Piece& b) { return a.triangle < b.triangle; });
}

}  // namespace

Interval interval(const Triangle& t, int axis) {
  return {std::min({t[0][axis], t[1][axis], t[2][axis]}), std::max({t[0][axis], t[1][axis], t[2][axis]})};
}

Interval interval(std::span<const Point3d> polygon, int axis) {
  Interval i{polygon[0][axis], polygon[0][axis]};
  for (const Point3d& p : polygon) i = {std::min(i.lower, p[axis]), std::max(i.upper, p[axis])};
  return i;
}

Point3d crossing(Point3d below, Point3d above, Plane plane) {
  const double t = (plane.split - below[plane.axis]) / (above[plane.axis] - below[plane.axis]);
  const auto between = [t](double a, double b) {
    return std::clamp(a + t * (b - a), std::min(a, b), std::max(a, b));
  };
  const double c = plane.split;
  return {plane.axis == 0 ? c : between(below.x, above.x), plane.axis == 1 ? c : between(below.y, above.y),
          plane.axis == 2 ? c : between(below.z, above.z)};
}

std::pair<CellContent, CellContent> cut(const CellContent& content, std::span<const Triangle> triangles,
                                        Plane plane) {
  CellContent below, above;
  for (const Piece& piece : content.pieces) {
    const Interval i = interval(content.polygon(piece), plane.axis);
    if (!reaches_above(i, plane.split)) {
      copy_piece(content, piece, below);
    } else if (!reaches_below(i, plane.split)) {
      copy_piece(content, piece, above);
    } else {
      cut_polygon(piece.triangle, content.polygon(piece), plane, below, above);
    }
  }
  for (const std::uint32_t id : content.whole) {
    const Triangle& t = triangles[id];
    const Interval i = interval(t, plane.axis);
    if (!reaches_above(i, plane.split)) {
      below.whole.push_back(id);
    } else if (!reaches_below(i, plane.split)) {
      above.whole.push_back(id);
    } else {
      const std::array<Point3d, 3> polygon{cast<double>(t[0]), cast<double>(t[1]), cast<double>(t[2])};
      cut_polygon(id, polygon, plane, below, above);
    }
  }
  sort_pieces(below);
  sort_pieces(above);
  return {std::move(below), std::move(above)};
}

}  // namespace vitrail
