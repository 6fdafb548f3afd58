// SPDX-License-Identifier: Apache-2.0
#include "tracer/rays/domain_tree.h"

#include <algorithm>

namespace vitrail {

namespace {

// A kd-tree's leaf is a leaf of these, too.
static_assert(KdNode::leaf_bit == BvhNode::cluster_bit);
// A chain of planes becomes no longer a chain of nodes.
static_assert(max_kd_depth <= max_bvh_depth);

struct Child {
  std::uint32_t reference = 0;  // of a KdNode
  Bounds3f box;                 // of all that is in it
};

class Builder {
 public:
  explicit Builder(const Manifest& manifest) : manifest_(manifest), boxes_(manifest.kd_nodes.size()) {
    if (boxes_.empty() || measure(0).empty()) return;
    add({0, boxes_[0]});
  }
  std::vector<BvhNode> take() { return std::move(out_); }

 private:
  static bool is_leaf(std::uint32_t reference) { return (reference & KdNode::leaf_bit) != 0; }
  Bounds3f box_of(std::uint32_t reference) const {
    return is_leaf(reference) ? manifest_.domains[reference & ~KdNode::leaf_bit].tight_bounds
                              : boxes_[reference];
  }

  Bounds3f measure(std::uint32_t reference) {
    if (is_leaf(reference)) return box_of(reference);
    const KdNode& node = manifest_.kd_nodes[reference];
    Bounds3f box = measure(node.below);
    const Bounds3f above = measure(node.above);
    if (box.empty())
      box = above;
    else if (!above.empty())
      extend(box, above);
    return boxes_[reference] = box;
  }

  // The largest of them that has children gives way to these, until there are eight.
  std::vector<Child> children_of(const Child& parent) const {
    std::vector<Child> children{parent};
    for (;;) {
      auto largest = children.end();
      for (auto c = children.begin(); c != children.end(); ++c)
        if (!is_leaf(c->reference) &&
            (largest == children.end() || surface_area(c->box) > surface_area(largest->box)))
          largest = c;
      if (largest == children.end() || children.size() == 8) return children;
      const KdNode& node = manifest_.kd_nodes[largest->reference];
      children.erase(largest);
      for (const std::uint32_t half : {node.below, node.above})
        if (!box_of(half).empty()) children.push_back({half, box_of(half)});
    }
  }

  std::uint32_t add(const Child& parent) {
    const auto index = static_cast<std::uint32_t>(out_.size());
    out_.push_back(empty_node());
    const std::vector<Child> children = children_of(parent);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const Child& c = children[i];
      const std::uint32_t reference = is_leaf(c.reference) ? c.reference : add(c);
      BvhNode& node = out_[index];
      node.child[i] = reference;
      for (int axis = 0; axis < 3; ++axis) {
        node.lower[axis][i] = c.box.lower[axis];
        node.upper[axis][i] = c.box.upper[axis];
      }
    }
    return index;
  }

  static BvhNode empty_node() {
    BvhNode node{};
    std::fill_n(&node.lower[0][0], 24, std::numeric_limits<float>::infinity());
    std::fill_n(&node.upper[0][0], 24, -std::numeric_limits<float>::infinity());
    std::fill_n(node.child, 8, BvhNode::empty);
    return node;
  }

  const Manifest& manifest_;
  std::vector<Bounds3f> boxes_;  // of the kd-tree's nodes
  std::vector<BvhNode> out_;
};

}  // namespace

std::vector<BvhNode> domain_tree(const Manifest& manifest) { return Builder(manifest).take(); }

}  // namespace vitrail
