// SPDX-License-Identifier: Apache-2.0
#include "partitioner/build_bvh.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "scene/diagnostics.h"

namespace vitrail {
namespace {

// What Embree builds: a binary tree whose leaves are the clusters. `count` is 0 for an inner node.
struct BinaryNode {
  std::uint32_t count = 0;
  std::uint32_t reference[cluster_width];
  BinaryNode* child[2];
  Bounds3f bounds[2];  // of the children
  // The plan of the wide tree. cost[i]: the least sum of the areas of the wide nodes below when the subtree
  // hangs in its parent as at most i = 1 … 8 children. share[i]: how many of them the first child has; 0: as
  // with i − 1.
  float cost[9] = {};
  std::uint8_t share[9] = {};
};

struct Subtree {
  const BinaryNode* node = nullptr;
  Bounds3f bounds;
};

using Device = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using Bvh = std::unique_ptr<RTCBVHTy, decltype(&rtcReleaseBVH)>;

// One for all: a new one reads Embree's settings from files, 30 µs.
RTCDevice shared_device() {
  static const Device device(rtcNewDevice(nullptr), &rtcReleaseDevice);
  if (!device) throw MachineError("embree cannot start: error " + std::to_string(rtcGetDeviceError(nullptr)));
  return device.get();
}

BinaryNode* allocate_node(RTCThreadLocalAllocator allocator) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(BinaryNode), 16)) BinaryNode;
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) { return allocate_node(allocator); }

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) {
    static_cast<BinaryNode*>(node)->child[i] = static_cast<BinaryNode*>(children[i]);
  }
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) {
    const RTCBounds& b = *bounds[i];
    static_cast<BinaryNode*>(node)->bounds[i] = {{b.lower_x, b.lower_y, b.lower_z},
                                                 {b.upper_x, b.upper_y, b.upper_z}};
  }
}

// Embree's parallel partition leaves the references of a leaf in an order that depends on the threads: sort
// them.
void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void*) {
  BinaryNode* leaf = allocate_node(allocator);
  leaf->count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) leaf->reference[i] = primitives[i].primID;
  std::sort(leaf->reference, leaf->reference + count);
  return leaf;
}

const Bounds3f& bounds_of(const TriangleReference& r) { return r.bounds; }
const Bounds3f& bounds_of(const Bounds3f& b) { return b; }

template <class T>
std::vector<RTCBuildPrimitive> build_primitives(std::span<const T> references) {
  std::vector<RTCBuildPrimitive> primitives(references.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, references.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Bounds3f& b = bounds_of(references[i]);
      primitives[i] = {b.lower.x, b.lower.y, b.lower.z, 0,
                       b.upper.x, b.upper.y, b.upper.z, static_cast<std::uint32_t>(i)};
    }
  });
  return primitives;
}

BinaryNode* build_binary(RTCBVH bvh, std::vector<RTCBuildPrimitive>& primitives, unsigned leaf_size) {
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;  // binned SAH, no spatial splits
  arguments.maxDepth = max_bvh_depth;  // of its last 8 levels each halves what is left, whatever its SAH
  arguments.sahBlockSize = leaf_size;
  arguments.maxLeafSize = leaf_size;
  arguments.bvh = bvh;
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  return static_cast<BinaryNode*>(rtcBuildBVH(&arguments));
}

// The wide tree of least SAH cost, by dynamic programming from the leaves (Ylitie, Karras & Laine 2017). The
// clusters are given, so that only the areas of the nodes count.
void plan_wide_tree(BinaryNode& node, const Bounds3f& bounds) {
  if (node.count) return;
  for (int i = 0; i < 2; ++i) plan_wide_tree(*node.child[i], node.bounds[i]);
  const float *first = node.child[0]->cost, *second = node.child[1]->cost;
  node.cost[2] = first[1] + second[1];
  node.share[2] = 1;
  for (int i = 3; i <= 8; ++i) {
    node.cost[i] = node.cost[i - 1];
    for (int share = 1; share < i; ++share) {
      const float cost = first[share] + second[i - share];
      if (cost >= node.cost[i]) continue;
      node.cost[i] = cost;
      node.share[i] = static_cast<std::uint8_t>(share);
    }
  }
  node.cost[1] = surface_area(bounds) + node.cost[8];
}

// x moved by padding + 10⁻⁶|x| towards `towards`, which is ±∞, and rounded the same way. Not less than 10⁻³⁷:
// Embree may take subnormal numbers for 0, and slabs lose their bits.
float inflate(float x, double padding, float towards) {
  const double moved =
      double{x} + std::copysign(padding + 1e-6 * std::abs(double{x}) + 1e-37, double{towards});
  return std::nextafter(static_cast<float>(moved), towards);
}

// Collapses the binary tree and writes nodes and leaves, depth first. `add_leaf(node)` returns the number of
// the leaf.
template <class AddLeaf>
class Collapser {
 public:
  Collapser(double padding, std::vector<BvhNode>& nodes, AddLeaf add_leaf)
      : padding_(padding), nodes_(nodes), add_leaf_(add_leaf) {}

  void add_root(const Subtree& root) {
    if (root.node->count) {
      add_node(&root, &root + 1);
    } else {
      add_inner(*root.node);
    }
  }

 private:
  std::uint32_t add_node(const Subtree* begin, const Subtree* end) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(empty_node());
    for (int i = 0; begin != end; ++begin, ++i) {
      set_box(nodes_[index], i, begin->bounds);
      const std::uint32_t child =
          begin->node->count ? BvhNode::cluster_bit | add_leaf_(*begin->node) : add_inner(*begin->node);
      nodes_[index].child[i] = child;
    }
    return index;
  }

  std::uint32_t add_inner(const BinaryNode& root) {
    Subtree children[8];
    return add_node(children, cut(root, 8, children));
  }

  // The subtrees of a plan; returns their end.
  static Subtree* cut(const BinaryNode& node, int count, Subtree* out) {
    while (node.share[count] == 0) --count;
    const int shares[2] = {node.share[count], count - node.share[count]};
    for (int i = 0; i < 2; ++i) {
      const BinaryNode& child = *node.child[i];
      if (shares[i] == 1 || child.count) {
        *out++ = {&child, node.bounds[i]};
      } else {
        out = cut(child, shares[i], out);
      }
    }
    return out;
  }

  static BvhNode empty_node() {
    BvhNode node{};
    std::fill_n(&node.lower[0][0], 24, std::numeric_limits<float>::infinity());
    std::fill_n(&node.upper[0][0], 24, -std::numeric_limits<float>::infinity());
    std::fill_n(node.child, 8, BvhNode::empty);
    return node;
  }

  void set_box(BvhNode& node, int child, const Bounds3f& bounds) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      node.lower[axis][child] = inflate(bounds.lower[axis], padding_, -infinity);
      node.upper[axis][child] = inflate(bounds.upper[axis], padding_, infinity);
    }
  }

  double padding_;
  std::vector<BvhNode>& nodes_;
  AddLeaf add_leaf_;
};

std::uint32_t add_cluster(std::span<const TriangleReference> references, const BinaryNode& leaf,
                          ClusteredTriangles& out) {
  const auto index = static_cast<std::uint32_t>(out.clusters.size());
  Cluster& cluster = out.clusters.emplace_back();
  for (std::uint32_t lane = 0; lane < cluster_width; ++lane) {
    const bool filled = lane < leaf.count;
    const std::uint32_t reference = filled ? leaf.reference[lane] : no_triangle;
    out.lane_reference.push_back(reference);
    cluster.id[lane] = filled ? references[reference].id : no_triangle;
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      for (int axis = 0; axis < 3; ++axis) {
        cluster.vertex[vertex][axis][lane] =
            filled ? references[reference].vertices[vertex][axis] : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
  return index;
}

// Nodes over `references`; see Collapser.
template <class T, class AddLeaf>
void build_nodes(std::span<const T> references, unsigned leaf_size, double padding,
                 std::vector<BvhNode>& nodes, const AddLeaf& add_leaf) {
  const RTCDevice device = shared_device();
  const Bvh bvh(rtcNewBVH(device), &rtcReleaseBVH);
  std::vector<RTCBuildPrimitive> primitives = build_primitives(references);
  BinaryNode* binary = build_binary(bvh.get(), primitives, leaf_size);
  if (!binary) {
    throw MachineError("embree cannot build a hierarchy over " + std::to_string(references.size()) +
                       " boxes: error " + std::to_string(rtcGetDeviceError(device)));
  }
  Subtree root{binary, {}};
  for (const T& r : references) extend(root.bounds, bounds_of(r));
  plan_wide_tree(*binary, root.bounds);
  Collapser(padding, nodes, add_leaf).add_root(root);
}

}  // namespace

ClusteredTriangles build_bvh(std::span<const TriangleReference> references, float padding) {
  ClusteredTriangles out;
  if (references.empty()) return out;
  out.nodes.reserve(references.size() / 24 + 1);
  out.clusters.reserve(references.size() / 6 + 1);
  out.lane_reference.reserve(out.clusters.capacity() * cluster_width);
  build_nodes(references, cluster_width, double{padding}, out.nodes,
              [&](const BinaryNode& leaf) { return add_cluster(references, leaf, out); });
  return out;
}

Bounds3f inflated(const Bounds3f& box, float padding) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Bounds3f out;
  for (int axis = 0; axis < 3; ++axis) {
    out.lower[axis] = inflate(box.lower[axis], double{padding}, -infinity);
    out.upper[axis] = inflate(box.upper[axis], double{padding}, infinity);
  }
  return out;
}

std::vector<BvhNode> build_tree(std::span<const Bounds3f> boxes, float padding) {
  std::vector<BvhNode> nodes;
  if (!boxes.empty())
    build_nodes(boxes, 1, double{padding}, nodes, [](const BinaryNode& leaf) { return leaf.reference[0]; });
  return nodes;
}

}  // namespace vitrail
