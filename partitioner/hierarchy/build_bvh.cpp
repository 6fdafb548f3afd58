// SPDX-License-Identifier: Apache-2.0
#include "partitioner/hierarchy/build_bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "partitioner/hierarchy/binary_tree.h"

namespace vitrail {
namespace {

// x moved by padding + 10⁻⁶|x| towards `towards`, which is ±∞, and rounded the same way. Not less than 10⁻³⁷:
// Embree may take subnormal numbers for 0, and slabs lose their bits.
float inflate(float x, double padding, float towards) {
  const double moved =
      double{x} + std::copysign(padding + 1e-6 * std::abs(double{x}) + 1e-37, double{towards});
  return std::nextafter(static_cast<float>(moved), towards);
}

// Collapses the binary tree and writes nodes and leaves, depth first.
class Collapser {
 public:
  Collapser(const BinaryTree& tree, unsigned leaf_size, BoxTree& out)
      : tree_(tree), leaf_size_(leaf_size), out_(out) {}

  void add_root() {
    if (is_leaf(tree_.root))
      add_node(&tree_.root, &tree_.root + 1);
    else
      add_inner(tree_.root);
  }

 private:
  bool is_leaf(std::uint32_t node) const { return tree_.nodes[node].child[1] == 0; }

  std::uint32_t add_node(const std::uint32_t* begin, const std::uint32_t* end) {
    const auto index = static_cast<std::uint32_t>(out_.nodes.size());
    out_.nodes.push_back(empty_node());
    for (int i = 0; begin != end; ++begin, ++i) {
      set_box(out_.nodes[index], i, tree_.nodes[*begin]);
      const std::uint32_t child =
          is_leaf(*begin) ? BvhNode::cluster_bit | add_leaf(tree_.nodes[*begin]) : add_inner(*begin);
      out_.nodes[index].child[i] = child;
    }
    return index;
  }

  std::uint32_t add_inner(std::uint32_t root) {
    std::uint32_t children[8];
    return add_node(children, cut(tree_.nodes[root], 8, children));
  }

  std::uint32_t add_leaf(const BinaryNode& leaf) {
    const std::size_t begin = out_.leaves.size();
    out_.leaves.resize(begin + leaf_size_, no_triangle);
    std::copy_n(&tree_.order[leaf.first], leaf.count, &out_.leaves[begin]);
    return static_cast<std::uint32_t>(begin / leaf_size_);
  }

  // The subtrees of a plan; returns their end.
  std::uint32_t* cut(const BinaryNode& node, unsigned count, std::uint32_t* out) const {
    while (node.share[count - 2] == 0) --count;
    const unsigned shares[2] = {node.share[count - 2], count - node.share[count - 2]};
    for (int i = 0; i < 2; ++i) {
      const std::uint32_t child = node.child[i];
      if (shares[i] == 1 || is_leaf(child))
        *out++ = child;
      else
        out = cut(tree_.nodes[child], shares[i], out);
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

  void set_box(BvhNode& node, int child, const BinaryNode& from) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      node.lower[axis][child] = inflate(from.lower[axis], 0, -infinity);
      node.upper[axis][child] = inflate(from.upper[axis], 0, infinity);
    }
  }

  const BinaryTree& tree_;
  unsigned leaf_size_;
  BoxTree& out_;
};

}  // namespace

BoxTree build_bvh(std::span<const Bounds3f> boxes, unsigned leaf_size) {
  BoxTree out;
  if (boxes.empty()) return out;
  const BinaryTree tree = build_binary_tree(boxes, leaf_size);
  out.nodes.reserve(boxes.size() / (std::size_t{3} * leaf_size) + 1);
  out.leaves.reserve(boxes.size() / 3 * 4 + leaf_size);
  Collapser(tree, leaf_size, out).add_root();
  return out;
}

std::vector<BvhNode> build_tree(std::span<const Bounds3f> boxes) {
  BoxTree tree = build_bvh(boxes, 1);
  for (BvhNode& node : tree.nodes)
    for (std::uint32_t& child : node.child)
      if (child != BvhNode::empty && child & BvhNode::cluster_bit)
        child = BvhNode::cluster_bit | tree.leaves[child & ~BvhNode::cluster_bit];
  return std::move(tree.nodes);
}

double greatest(const Bounds3f& box) {
  double most = 0;
  for (int axis = 0; axis < 3 && !box.empty(); ++axis)
    most = std::max({most, std::abs(double{box.lower[axis]}), std::abs(double{box.upper[axis]})});
  return most;
}

Bounds3f inflated(const Bounds3f& box, double padding) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Bounds3f out;
  for (int axis = 0; axis < 3; ++axis) {
    out.lower[axis] = inflate(box.lower[axis], padding, -infinity);
    out.upper[axis] = inflate(box.upper[axis], padding, infinity);
  }
  return out;
}

}  // namespace vitrail
