// SPDX-License-Identifier: Apache-2.0
#include "partitioner/hierarchy/binary_tree.h"

#include <embree3/rtcore.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <random>

#include "bundle/domain_file.h"

namespace vitrail::binary_tree_test {
namespace {

using Boxes = std::vector<Bounds3f>;

constexpr unsigned leaf_size = 8;

// Of boxes of random places around `centre` and sizes.
void add_boxes(Boxes& boxes, std::size_t count, Point3f centre, float reach, float size) {
  std::mt19937 random(static_cast<unsigned>(boxes.size()));
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (std::size_t i = 0; i < count; ++i) {
    const Point3f p = centre + Vector3f{uniform(random), uniform(random), uniform(random)} * reach;
    Bounds3f& b = boxes.emplace_back();
    for (int k = 0; k < 2; ++k)
      extend(b, p + Vector3f{uniform(random), uniform(random), uniform(random)} * size);
  }
}

// Σ area of all nodes but the root, and of leaves.
double cost(const BinaryTree& tree) {
  double sum = 0;
  std::vector<std::uint32_t> open{tree.root};
  while (!open.empty()) {
    const BinaryNode& node = tree.nodes[open.back()];
    open.pop_back();
    for (const std::uint32_t child : node.child) {
      if (node.child[1] == 0) break;
      sum += double{half_area(tree.nodes[child].upper - tree.nodes[child].lower)};
      open.push_back(child);
    }
  }
  return sum;
}

// The same of Embree's builder, which has threads of its own however many its device is given.
double embree_cost(const Boxes& boxes) {
  std::vector<RTCBuildPrimitive> primitives;
  for (const Bounds3f& b : boxes)
    primitives.push_back({b.lower.x, b.lower.y, b.lower.z, 0, b.upper.x, b.upper.y, b.upper.z,
                          static_cast<unsigned>(primitives.size())});
  const RTCDevice device = rtcNewDevice("threads=1");
  const RTCBVH bvh = rtcNewBVH(device);
  std::atomic<double> sum = 0;
  RTCBuildArguments a = rtcDefaultBuildArguments();
  a.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  a.sahBlockSize = a.maxLeafSize = leaf_size;
  a.bvh = bvh;
  a.primitives = primitives.data();
  a.primitiveCount = a.primitiveArrayCapacity = primitives.size();
  a.userPtr = &sum;
  a.createNode = [](RTCThreadLocalAllocator memory, unsigned, void*) {
    return rtcThreadLocalAlloc(memory, 16, 16);
  };
  a.setNodeChildren = [](void*, void**, unsigned, void*) {};
  a.setNodeBounds = [](void*, const RTCBounds** bounds, unsigned count, void* user) {
    for (unsigned i = 0; i < count; ++i) {
      const RTCBounds& b = *bounds[i];
      *static_cast<std::atomic<double>*>(user) +=
          double{half_area(Float4{b.upper_x - b.lower_x, b.upper_y - b.lower_y, b.upper_z - b.lower_z})};
    }
  };
  a.createLeaf = [](RTCThreadLocalAllocator memory, const RTCBuildPrimitive*, std::size_t, void*) {
    return rtcThreadLocalAlloc(memory, 16, 16);
  };
  rtcBuildBVH(&a);
  rtcReleaseBVH(bvh);
  rtcReleaseDevice(device);
  return sum;
}

// Every box in one leaf, inside the boxes of all nodes above.
void expect_valid(const BinaryTree& tree, const Boxes& boxes) {
  std::vector<int> seen(boxes.size());
  struct Open {
    std::uint32_t node;
    int level;
  };
  std::vector<Open> open{{tree.root, 1}};
  while (!open.empty()) {
    const auto [at, level] = open.back();
    open.pop_back();
    const BinaryNode& node = tree.nodes[at];
    EXPECT_LE(level, max_bvh_depth);
    if (node.child[1] != 0) {
      for (const std::uint32_t child : node.child) {
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_LE(node.lower[axis], tree.nodes[child].lower[axis]);
          EXPECT_GE(node.upper[axis], tree.nodes[child].upper[axis]);
        }
        open.push_back({child, level + 1});
      }
      continue;
    }
    ASSERT_TRUE(node.count >= 1 && node.count <= leaf_size);
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      ++seen.at(tree.order[i]);
      const Bounds3f& b = boxes[tree.order[i]];
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(node.lower[axis], b.lower[axis]);
        EXPECT_GE(node.upper[axis], b.upper[axis]);
      }
    }
  }
  for (const int n : seen) EXPECT_EQ(n, 1);
}

void expect_as_good_as_embree(const Boxes& boxes) {
  const BinaryTree tree = build_binary_tree(boxes, leaf_size);
  expect_valid(tree, boxes);
  EXPECT_LT(cost(tree), 1.02 * embree_cost(boxes));
}

TEST(BinaryTree, EvenlySpreadBoxes) {
  Boxes boxes;
  add_boxes(boxes, 100'000, {}, 1, 0.01f);
  expect_as_good_as_embree(boxes);
}

TEST(BinaryTree, FewBoxes) {
  Boxes boxes;
  add_boxes(boxes, 3000, {}, 1, 0.05f);
  expect_as_good_as_embree(boxes);
}

// A detailed room in a plain landscape: a large box in a bucket of small ones would spoil it.
TEST(BinaryTree, FewLargeBoxesAmongSmallOnes) {
  Boxes boxes;
  add_boxes(boxes, 200, {}, 100, 30);
  add_boxes(boxes, 100'000, {3, 4, 5}, 1, 0.01f);
  add_boxes(boxes, 2000, {3, 4, 5}, 1, 0.5f);
  expect_as_good_as_embree(boxes);
}

TEST(BinaryTree, ClustersOfManySizes) {
  Boxes boxes;
  for (int i = 0; i < 12; ++i) {
    const float size = std::ldexp(1.0f, -2 * i);
    add_boxes(boxes, 10'000, {size * 3, 0, size}, size, size * 0.02f);
  }
  expect_as_good_as_embree(boxes);
}

// An error or an interrupt cancels all work of a partitioning; what is being built has to stay readable.
TEST(BinaryTree, IsWholeInWorkThatIsCancelled) {
  Boxes boxes;
  add_boxes(boxes, 50'000, {}, 1, 0.01f);
  tbb::task_group_context cancelled;
  tbb::parallel_for(
      0, 1,
      [&](int) {
        cancelled.cancel_group_execution();
        expect_valid(build_binary_tree(boxes, leaf_size), boxes);
      },
      cancelled);
}

TEST(BinaryTree, HugeAndTinyNumbers) {
  Boxes boxes;
  add_boxes(boxes, 10'000, {}, 1e38f, 2e38f);
  add_boxes(boxes, 10'000, {}, 1e-40f, 1e-42f);
  boxes.insert(boxes.end(), 10'000, boxes.back());
  expect_valid(build_binary_tree(boxes, leaf_size), boxes);
}

}  // namespace
}  // namespace vitrail::binary_tree_test
