// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cutting/choose_plane.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/test_scenes.h"

namespace vitrail::choose_plane_test {

namespace {

std::vector<Item> items_of(const std::vector<Triangle>& triangles) {
  std::vector<Item> all(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const Point3f& p : triangles[i]) extend(all[i].bounds, p);
  return all;
}

// Both sides of the plane.
std::array<CellContent, 2> cut(const std::vector<Triangle>& triangles, Plane plane) {
  const KdNode root{plane.split, static_cast<std::uint32_t>(plane.axis), KdNode::leaf_bit,
                    KdNode::leaf_bit | 1};
  std::array<CellContent, 2> leaves;
  route(triangles, 0, static_cast<std::uint32_t>(triangles.size()), {}, std::span(&root, 1), leaves);
  return leaves;
}

// A flat n × m grid of unit squares, z = 0.
std::vector<Triangle> grid(int n, int m) {
  std::vector<Triangle> triangles;
  const auto at = [](int x, int y) { return Point3f{static_cast<float>(x), static_cast<float>(y), 0}; };
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < m; ++y) {
      triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return triangles;
}

TEST(ChoosePlane, NothingToPart) {
  EXPECT_FALSE(choose_plane({}, {}));
  const std::vector<Triangle> point(5, Triangle{});
  EXPECT_FALSE(choose_plane(items_of(point), {}));
}

// The long axis has the smaller section, and its grid lines cut no triangle.
TEST(ChoosePlane, FollowsTheMeshAcrossTheLongAxis) {
  const std::vector<Triangle> triangles = grid(40, 10);
  const auto plane = choose_plane(items_of(triangles), {2, 1, 0.1});
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->plane.axis, 0);
  EXPECT_EQ(plane->plane.split, 20);
  const auto [below, above] = cut(triangles, plane->plane);
  EXPECT_EQ(below.size(), 400u);
  EXPECT_TRUE(below.pieces.empty());
}

// The plane lies where so many domains have their share.
TEST(ChoosePlane, SharesTheLoadByDomains) {
  const std::vector<Triangle> triangles = grid(50, 5);
  const auto cut = choose_plane(items_of(triangles), {5, 1, 0.02});
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->plane.split, static_cast<float>(10 * cut->domains_below));
  for (const std::uint32_t least : {1u, 2u}) {
    const auto bounded = choose_plane(items_of(triangles), {5, least, 0.02});
    ASSERT_TRUE(bounded);
    EXPECT_GE(bounded->domains_below, least);
    EXPECT_LE(bounded->domains_below, 5 - least);
  }
}

// A dense part gets a box of its own, with its share of the domains, instead of being halved.
TEST(ChoosePlane, PartsDenseFromWide) {
  std::vector<Triangle> triangles = grid(10, 10);
  for (Triangle t : grid(60, 60)) {
    for (Point3f& p : t) p = {20 + p.x / 60, p.y / 60, p.z};
    triangles.push_back(t);
  }
  const auto cut = choose_plane(items_of(triangles), {100, 1, 0.1});
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->plane.axis, 0);
  EXPECT_GE(cut->plane.split, 10);
  EXPECT_LE(cut->plane.split, 20);
  EXPECT_EQ(cut->domains_below, 3u);
  const auto median = median_plane(items_of(triangles), {100, 1, 0.1});
  ASSERT_TRUE(median);
  EXPECT_EQ(median->domains_below, 50u);
  EXPECT_GT(median->plane.split, 20);
}

// All triangles lie in two planes: the only way between them is one that no triangle names.
TEST(ChoosePlane, PartsParallelSheets) {
  std::vector<Triangle> triangles;
  for (int i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(i % 2);
    triangles.push_back({Point3f{x, 0, 0}, Point3f{x, 1, 0}, Point3f{x, 0, 1}});
  }
  const auto plane = choose_plane(items_of(triangles), {2, 1, 0.05});
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->plane.axis, 0);
  const auto [below, above] = cut(triangles, plane->plane);
  EXPECT_EQ(below.whole.size(), 50u);
  EXPECT_EQ(above.whole.size(), 50u);
}

// Most triangles in a tiny corner: even spacing alone would put nearly all on one side.
TEST(ChoosePlane, BalancesUnevenScenes) {
  std::vector<Triangle> triangles = grid(30, 30);
  for (Triangle& t : triangles)
    for (Point3f& p : t) p = {p.x * 1e-4f, p.y * 1e-4f, p.z};
  triangles.push_back({Point3f{1000, 0, 0}, Point3f{1000, 1, 0}, Point3f{1000, 0, 1}});
  const auto plane = choose_plane(items_of(triangles), {2, 1, 0.1});
  ASSERT_TRUE(plane);
  const auto [below, above] = cut(triangles, plane->plane);
  EXPECT_LT(std::max(below.size(), above.size()), 1.1 * static_cast<double>(triangles.size()) / 2);
}

}  // namespace

}  // namespace vitrail::choose_plane_test
