// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cstring>
#include <random>

#include "tests/partitioner/hierarchy/clustered_mesh.h"

namespace vitrail::test::build_bvh_test {
namespace {

Triangles soup(int count, float size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-1, 1);
  Triangles triangles(static_cast<std::size_t>(count));
  for (Triangle& triangle : triangles) {
    const Point3f center{uniform(random), uniform(random), uniform(random)};
    for (Point3f& p : triangle) {
      p = center + Vector3f{uniform(random), uniform(random), uniform(random)} * size;
    }
  }
  return triangles;
}

bool contains(const BvhNode& node, std::size_t child, const Bounds3f& inner) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(node.lower[axis][child] <= inner.lower[axis] && inner.upper[axis] <= node.upper[axis][child]))
      return false;
  }
  return true;
}

Bounds3f bounds_of(const Cluster& cluster) {
  Bounds3f bounds;
  for (std::size_t lane = 0; lane < cluster_width; ++lane) {
    if (cluster.id[lane] == no_triangle) continue;
    for (const auto& vertex : cluster.vertex)
      extend(bounds, Point3f{vertex[0][lane], vertex[1][lane], vertex[2][lane]});
  }
  return bounds;
}

Bounds3f bounds_of(const BvhNode& node) {
  Bounds3f bounds;
  for (std::size_t i = 0; i < 8; ++i) {
    if (node.child[i] == BvhNode::empty) continue;
    extend(bounds, Point3f{node.lower[0][i], node.lower[1][i], node.lower[2][i]});
    extend(bounds, Point3f{node.upper[0][i], node.upper[1][i], node.upper[2][i]});
  }
  return bounds;
}

// Each reference in one lane, each node and cluster in one place and after its parent, boxes nested.
void expect_valid(const ClusteredTriangles& c, const Triangles& triangles) {
  std::vector<int> seen(triangles.size()), parents(c.nodes.size()), owners(c.clusters.size());
  ASSERT_EQ(c.lane_reference.size(), c.clusters.size() * cluster_width);
  for (std::size_t i = 0; i < c.lane_reference.size(); ++i) {
    const Cluster& cluster = c.clusters[i / cluster_width];
    const std::size_t lane = i % cluster_width;
    if (c.lane_reference[i] == no_triangle) {
      EXPECT_EQ(cluster.id[lane], no_triangle);
      EXPECT_TRUE(std::isnan(cluster.vertex[0][0][lane]));
      continue;
    }
    ++seen[c.lane_reference[i]];
    EXPECT_EQ(cluster.id[lane], c.lane_reference[i]);
    EXPECT_EQ(cluster.vertex[2][1][lane], triangles[c.lane_reference[i]][2].y);
  }
  std::vector<int> level(c.nodes.size(), 1);
  for (std::size_t i = 0; i < c.nodes.size(); ++i) {
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t child = c.nodes[i].child[k], index = child & ~BvhNode::cluster_bit;
      if (child == BvhNode::empty) continue;
      if (child & BvhNode::cluster_bit) {
        ++owners.at(index);
        EXPECT_TRUE(contains(c.nodes[i], k, bounds_of(c.clusters[index])));
      } else {
        ASSERT_GT(index, i);
        ++parents.at(index);
        level[index] = level[i] + 1;
        EXPECT_LE(level[index], max_bvh_depth);
        // A child's boxes are inflated as much as their union is: the same to one rounding.
        const Bounds3f inner = bounds_of(c.nodes[index]);
        EXPECT_TRUE(contains(c.nodes[i], k, inner)) << "node " << i << " child " << k;
      }
    }
  }
  EXPECT_EQ(parents[0], 0);
  for (std::size_t i = 1; i < parents.size(); ++i) EXPECT_EQ(parents[i], 1);
  for (const int n : owners) EXPECT_EQ(n, 1);
  for (const int n : seen) EXPECT_EQ(n, 1);
}

bool same_bytes(const ClusteredTriangles& a, const ClusteredTriangles& b) {
  return a.nodes.size() == b.nodes.size() && a.clusters.size() == b.clusters.size() &&
         a.lane_reference == b.lane_reference &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0 &&
         std::memcmp(a.clusters.data(), b.clusters.data(), a.clusters.size() * sizeof(Cluster)) == 0;
}

ClusteredTriangles cluster_with_threads(const Triangles& triangles, int threads) {
  tbb::task_arena arena(threads);
  return arena.execute([&] { return cluster(triangles); });
}

TEST(BuildBvh, NothingGivesNothing) {
  const ClusteredTriangles c = cluster({});
  EXPECT_TRUE(c.nodes.empty() && c.clusters.empty() && c.lane_reference.empty());
}

TEST(BuildBvh, FewTrianglesAreOneCluster) {
  for (const int count : {1, 2, 8}) {
    const Triangles triangles = soup(count, 0.1f);
    const ClusteredTriangles c = cluster(triangles);
    EXPECT_EQ(c.nodes.size(), 1u);
    EXPECT_EQ(c.clusters.size(), 1u);
    expect_valid(c, triangles);
  }
}

TEST(BuildBvh, ManyTriangles) {
  const Triangles triangles = soup(30'000, 0.01f);
  const ClusteredTriangles c = cluster(triangles);
  expect_valid(c, triangles);
  EXPECT_GT(30'000.0 / static_cast<double>(c.clusters.size()), 6.5);
}

TEST(BuildBvh, IdenticalTriangles) {
  const Triangles triangles(100'000, Triangle{Point3f{0.5f, 0, 0}, Point3f{0.5f, 1, 0}, Point3f{0.5f, 0, 1}});
  expect_valid(cluster(triangles), triangles);
}

TEST(BuildBvh, PointsWithoutExtent) {
  Triangles triangles = soup(1000, 0);
  triangles.insert(triangles.end(), 1000, Triangle{});
  expect_valid(cluster(triangles), triangles);
}

TEST(BuildBvh, SizesOverManyMagnitudes) {
  Triangles triangles;
  for (int i = 0; i < 20'000; ++i) {
    const float size = std::ldexp(1.0f, -(i % 100));
    triangles.push_back(
        {Point3f{size, size, size}, Point3f{size * 2, size, size}, Point3f{size, size * 2, size}});
  }
  expect_valid(cluster(triangles), triangles);
}

TEST(BuildBvh, ThreadsDoNotMatter) {
  for (const float size : {0.0f, 0.01f, 0.5f}) {
    Triangles triangles = soup(60'000, size);
    triangles.insert(triangles.end(), 5000, triangles[0]);
    const ClusteredTriangles one = cluster_with_threads(triangles, 1);
    EXPECT_TRUE(same_bytes(one, cluster_with_threads(triangles, 2)));
  }
}

}  // namespace
}  // namespace vitrail::test::build_bvh_test
