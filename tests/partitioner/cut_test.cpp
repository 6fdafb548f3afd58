// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cutting/cut.h"

#include <gtest/gtest.h>

#include <array>

#include "bundle/census.h"

namespace vitrail::cut_test {

namespace {

struct Halves {
  CellContent below, above;
};

// Of all triangles; `before`: those of which only a piece is there.
Halves cut(const std::vector<Triangle>& triangles, Plane plane, const CellContent& before = {}) {
  const KdNode root{plane.split, static_cast<std::uint32_t>(plane.axis), KdNode::leaf_bit,
                    KdNode::leaf_bit | 1};
  std::array<CellContent, 2> leaves;
  route(triangles, 0, static_cast<std::uint32_t>(triangles.size()), before, std::span(&root, 1), leaves);
  return {leaves[0], leaves[1]};
}

double area_of(const CellContent& content) {
  double sum = 0;
  for (const Piece& p : content.pieces) sum += polygon_area(content.polygon(p));
  return sum;
}

TEST(Cut, StraddlingTriangleBecomesTwoPieces) {
  const std::vector<Triangle> triangles{{Point3f{-1, 0, 0}, Point3f{3, 0, 0}, Point3f{0, 2, 0}}};
  const auto [below, above] = cut(triangles, {0, 1});
  EXPECT_TRUE(below.whole.empty() && above.whole.empty());
  ASSERT_EQ(below.pieces.size(), 1u);
  ASSERT_EQ(above.pieces.size(), 1u);
  EXPECT_EQ(below.pieces[0].vertex_count, 4u);
  EXPECT_EQ(above.pieces[0].vertex_count, 3u);
  EXPECT_DOUBLE_EQ(area_of(below) + area_of(above), 4);
  for (const Point3d& p : above.piece_vertices) EXPECT_GE(p.x, 1);
}

TEST(Cut, TouchingTrianglesStayWhole) {
  const std::vector<Triangle> triangles{
      {Point3f{0, 0, 0}, Point3f{1, 0, 0}, Point3f{1, 1, 0}},    // touches x = 1 from below
      {Point3f{1, 0, 0}, Point3f{2, 0, 0}, Point3f{1, 1, 0}},    // and from above
      {Point3f{1, 0, 0}, Point3f{1, 1, 0}, Point3f{1, 0, 1}},    // lies in it
      {Point3f{-1, 0, 0}, Point3f{-2, 0, 0}, Point3f{-1, 1, 0}}  // far below
  };
  const auto [below, above] = cut(triangles, {0, 1});
  EXPECT_EQ(below.whole, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(above.whole, (std::vector<std::uint32_t>{1}));
  EXPECT_TRUE(below.pieces.empty() && above.pieces.empty());
}

TEST(Cut, VertexInThePlaneBelongsToBothPieces) {
  const std::vector<Triangle> triangles{{Point3f{0, 0, 0}, Point3f{1, 1, 0}, Point3f{2, 0, 0}}};
  const auto [below, above] = cut(triangles, {0, 1});
  const Point3d apex{1, 1, 0}, foot{1, 0, 0};
  EXPECT_EQ(below.piece_vertices, (std::vector<Point3d>{{0, 0, 0}, apex, foot}));
  EXPECT_EQ(above.piece_vertices, (std::vector<Point3d>{apex, {2, 0, 0}, foot}));
}

// Where the first two cuts of a triangle nearly meet, rounding moves an edge of the polygon into the plane.
// The chord then begins at one of its ends, the same for both parts.
TEST(Cut, PartsWithAnEdgeInThePlaneDoNotOverlap) {
  std::vector<Point3d> polygon{{2, 0, 0}, {1, 5, 0}, {1, 4, 0}, {0, 0, 0}};
  for (int turn = 0; turn < 8; ++turn) {
    std::vector<Point3d> below, above;
    split_polygon(polygon, {0, 1}, below, above);
    EXPECT_DOUBLE_EQ(polygon_area(below) + polygon_area(above), polygon_area(polygon));
    EXPECT_EQ(below.size() + above.size(), 7u);
    std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    if (turn == 3) std::ranges::reverse(polygon);
  }
}

// Neighbours run along their common edge in opposite directions.
TEST(Cut, NeighboursGetTheSameBits) {
  const Point3f p{0.1f, 0.7f, -0.3f}, q{0.9f, -0.2f, 0.8f};
  const std::vector<Triangle> triangles{{p, q, Point3f{5, 5, 5}}, {q, p, Point3f{-5, 5, 5}}};
  for (const float split : {0.2f, 0.3f, 0.5f, 0.77f}) {
    const CellContent below = cut(triangles, {0, split}).below;
    const Point3d on_edge = crossing(cast<double>(p), cast<double>(q), {0, split});
    EXPECT_EQ(on_edge.x, double{split});
    for (const Piece& piece : below.pieces) {
      const auto polygon = below.polygon(piece);
      EXPECT_NE(std::find(polygon.begin(), polygon.end(), on_edge), polygon.end());
    }
  }
}

// Rounding must not push a cut vertex out of the cell that earlier cuts made.
TEST(Cut, CutVerticesStayWithinTheirSegment) {
  for (int i = 1; i < 2000; ++i) {
    const double edge = 1.0 / i;
    const Point3d below{edge, -1.0 / 3, 0.1}, above{edge * 0.99, i * 0.7, 0.1};
    const Point3d p = crossing(below, above, {1, 0.1f / static_cast<float>(i)});
    EXPECT_LE(p.x, below.x);
    EXPECT_GE(p.x, above.x);
    EXPECT_EQ(p.z, 0.1);
  }
}

TEST(Cut, PiecesStayInOrderAndWinding) {
  std::vector<Triangle> triangles;
  for (int i = 0; i < 10; ++i) {
    const auto y = static_cast<float>(i);
    triangles.push_back({Point3f{-2, y, 0}, Point3f{2, y, 0}, Point3f{0, y + 1, 0}});
  }
  const auto halves = cut(triangles, {0, -1});
  const auto [below, above] = cut(triangles, {0, 1}, halves.above);
  ASSERT_EQ(below.pieces.size(), 10u);
  for (std::uint32_t i = 0; i < 10; ++i) {
    EXPECT_EQ(below.pieces[i].triangle, i);
    const auto v = below.polygon(below.pieces[i]);
    EXPECT_GT(cross(v[1] - v[0], v[2] - v[0]).z, 0);
  }
}

}  // namespace

}  // namespace vitrail::cut_test
