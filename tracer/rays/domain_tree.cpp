// SPDX-License-Identifier: Apache-2.0
#include "tracer/rays/domain_tree.h"

#include <algorithm>
#include <array>

namespace vitrail {

namespace {

// A kd-tree's leaf is a leaf of these, too.
static_assert(KdNode::leaf_bit == BvhNode::cluster_bit);
// A chain of planes becomes no longer a chain of nodes.
static_assert(max_kd_depth <= max_bvh_depth);

struct Child {
  std::uint32_t reference = 0;  // of a KdNode
  Bounds3f box;                 // of all that is in it; empty where a domain is met again
};

class Builder {
 public:
  explicit Builder(const Manifest& manifest)
      : manifest_(manifest), halves_(manifest.kd_nodes.size()), met_(manifest.domains.size()) {
    if (halves_.empty()) return;
    const Bounds3f box = measure(0);
    if (!box.empty()) add({0, box});
  }
  std::vector<BvhNode> take() { return std::move(out_); }

 private:
  static bool is_leaf(std::uint32_t reference) { return (reference & KdNode::leaf_bit) != 0; }

  Bounds3f measure(std::uint32_t reference) {
    if (is_leaf(reference)) {
      const std::uint32_t domain = reference & ~KdNode::leaf_bit;
      if (met_[domain]) return {};
      met_[domain] = true;
      return manifest_.domains[domain].tight_bounds;
    }
    const KdNode& node = manifest_.kd_nodes[reference];
    const Child below{node.below, measure(node.below)}, above{node.above, measure(node.above)};
    halves_[reference] = {below, above};
    if (below.box.empty()) return above.box;
    Bounds3f box = below.box;
    if (!above.box.empty()) extend(box, above.box);
    return box;
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
      const std::array<Child, 2>& halves = halves_[largest->reference];
      children.erase(largest);
      for (const Child& half : halves)
        if (!half.box.empty()) children.push_back(half);
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
  std::vector<std::array<Child, 2>> halves_;  // of the kd-tree's nodes: below, above
  std::vector<bool> met_;                     // by domain
  std::vector<BvhNode> out_;
};

}  // namespace

std::vector<BvhNode> domain_tree(const Manifest& manifest) { return Builder(manifest).take(); }

}  // namespace vitrail
