// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cutting/cut.h"

#include <algorithm>

namespace vitrail {

void CellContent::add(std::uint32_t triangle, std::span<const Point3d> polygon) {
  pieces.push_back({triangle, static_cast<std::uint32_t>(piece_vertices.size()),
                    static_cast<std::uint32_t>(polygon.size())});
  piece_vertices.insert(piece_vertices.end(), polygon.begin(), polygon.end());
}

void CellContent::append(const CellContent& next, std::uint32_t first) {
  const auto first_vertex = static_cast<std::uint32_t>(piece_vertices.size());
  for (const std::uint32_t triangle : next.whole) whole.push_back(triangle + first);
  for (const Piece& p : next.pieces)
    pieces.push_back({p.triangle + first, p.first_vertex + first_vertex, p.vertex_count});
  piece_vertices.insert(piece_vertices.end(), next.piece_vertices.begin(), next.piece_vertices.end());
}

AxisExtent interval(const Triangle& t, int axis) {
  return {std::min({t[0][axis], t[1][axis], t[2][axis]}), std::max({t[0][axis], t[1][axis], t[2][axis]})};
}

AxisExtent interval(std::span<const Point3d> polygon, int axis) {
  AxisExtent i{polygon[0][axis], polygon[0][axis]};
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

void split_polygon(std::span<const Point3d> polygon, Plane plane, std::vector<Point3d>& below,
                   std::vector<Point3d>& above) {
  const std::size_t n = polygon.size();
  const auto side = [&](std::size_t i) {
    const double x = polygon[i % n][plane.axis], c = plane.split;
    return x < c ? -1 : x > c ? 1 : 0;
  };
  const auto side_beyond = [&](std::size_t i, std::size_t step) {
    for (std::size_t k = 1; k < n; ++k)
      if (const int s = side(i + k * step)) return s;
    return 0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const int here = side(i), next = side(i + 1);
    if (here == 0) {
      const int before = side_beyond(i, n - 1), after = side_beyond(i, 1);
      if (std::min(before, after) <= 0) below.push_back(polygon[i]);
      if (std::max(before, after) >= 0 && (before == after || std::max(side(i + n - 1), next) > 0))
        above.push_back(polygon[i]);
      continue;
    }
    (here < 0 ? below : above).push_back(polygon[i]);
    if (here * next < 0) {
      const Point3d p = polygon[i], q = polygon[(i + 1) % n];
      const Point3d between = here < 0 ? crossing(p, q, plane) : crossing(q, p, plane);
      below.push_back(between);
      above.push_back(between);
    }
  }
}

namespace {

Plane plane_of(const KdNode& node) { return {static_cast<int>(node.axis), node.split}; }

class Router {
 public:
  Router(std::span<const KdNode> nodes, std::span<CellContent> leaves) : nodes_(nodes), leaves_(leaves) {}

  void whole(std::uint32_t index, const Triangle& t) {
    std::uint32_t at = root();
    while (!(at & KdNode::leaf_bit)) {
      const KdNode& node = nodes_[at];
      const auto axis = static_cast<int>(node.axis);
      const float a = t[0][axis], b = t[1][axis], c = t[2][axis];
      const float lower = std::min({a, b, c}), upper = std::max({a, b, c});
      if (!(upper > node.split)) {
        at = node.below;
      } else if (!(lower < node.split)) {
        at = node.above;
      } else {
        const std::array<Point3d, 3> polygon{cast<double>(t[0]), cast<double>(t[1]), cast<double>(t[2])};
        return piece(index, polygon, at);
      }
    }
    leaves_[at & ~KdNode::leaf_bit].whole.push_back(index);
  }

  void piece(std::uint32_t index, std::span<const Point3d> polygon, std::uint32_t at) {
    while (!(at & KdNode::leaf_bit)) {
      const KdNode& node = nodes_[at];
      const AxisExtent i = interval(polygon, static_cast<int>(node.axis));
      if (!reaches_above(i, node.split)) {
        at = node.below;
      } else if (!reaches_below(i, node.split)) {
        at = node.above;
      } else {
        std::vector<Point3d> below, above;
        split_polygon(polygon, plane_of(node), below, above);
        piece(index, below, node.below);
        return piece(index, above, node.above);
      }
    }
    leaves_[at & ~KdNode::leaf_bit].add(index, polygon);
  }

  std::uint32_t root() const { return nodes_.empty() ? KdNode::leaf_bit : 0; }

 private:
  std::span<const KdNode> nodes_;
  std::span<CellContent> leaves_;
};

}  // namespace

void route(std::span<const Triangle> triangles, std::uint32_t begin, std::uint32_t end,
           const CellContent& cut_before, std::span<const KdNode> nodes, std::span<CellContent> leaves) {
  Router router(nodes, leaves);
  auto piece = std::ranges::lower_bound(cut_before.pieces, begin, {}, &Piece::triangle);
  for (std::uint32_t i = begin; i < end; ++i) {
    if (piece != cut_before.pieces.end() && piece->triangle == i)
      router.piece(i, cut_before.polygon(*piece++), router.root());
    else
      router.whole(i, triangles[i]);
  }
}

}  // namespace vitrail
