// SPDX-License-Identifier: Apache-2.0
#include "bundle/domain_structure.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Marks what has been referred to; false where it already was.
class OnceEach {
 public:
  explicit OnceEach(std::size_t size) : seen_(size, false) {}
  bool mark(std::size_t i) {
    if (seen_[i]) return false;
    seen_[i] = true;
    ++count_;
    return true;
  }
  bool all() const { return count_ == seen_.size(); }

 private:
  std::vector<bool> seen_;
  std::size_t count_ = 0;
};

// Where a node has no child its box is that of nothing, which no ray enters.
bool has_box_of_nothing(const BvhNode& node, std::size_t child) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (node.lower[axis][child] != infinity || node.upper[axis][child] != -infinity) return false;
  return true;
}

// Children come after their parent and every node and leaf hangs in exactly one place, so a traversal ends
// and its stack is bounded by the depth; a curve, which is an instance, may have several leaves.
void check_tree(const std::filesystem::path& file, std::span<const BvhNode> tree, std::size_t leaf_count,
                const char* leaf, bool may_repeat = false) {
  OnceEach nodes(tree.size()), leaves(leaf_count);
  std::vector<std::uint8_t> depth(tree.size(), 1);
  if (!tree.empty()) nodes.mark(0);
  for (std::size_t i = 0; i < tree.size(); ++i)
    for (std::size_t place = 0; place < std::size(tree[i].child); ++place) {
      const std::uint32_t child = tree[i].child[place];
      if (child == BvhNode::empty) {
        if (!has_box_of_nothing(tree[i], place))
          reject_domain(file, fmt::format("node {} has a box around no child", i));
        continue;
      }
      const std::size_t index = child & ~BvhNode::cluster_bit;
      if (child & BvhNode::cluster_bit) {
        if (index >= leaf_count || (!leaves.mark(index) && !may_repeat))
          reject_domain(file, fmt::format("node {} refers to {} {}", i, leaf, index));
      } else {
        if (index <= i || index >= tree.size() || !nodes.mark(index))
          reject_domain(file, fmt::format("node {} refers to node {}", i, index));
        depth[index] = static_cast<std::uint8_t>(depth[i] + 1);
        if (depth[index] > max_bvh_depth) reject_domain(file, "its tree is too deep");
      }
    }
  if (!nodes.all() || !leaves.all())
    reject_domain(file, fmt::format("its tree does not reach every {}", leaf));
}

void check_instances(const std::filesystem::path& file, std::span<const InstanceRef> instances) {
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const InstanceRef& ref = instances[i];
    bool finite = true;
    for (const auto& row : ref.to_parent.m)
      for (const double x : row) finite = finite && std::isfinite(x);
    for (int axis = 0; axis < 3; ++axis)
      finite = finite && std::isfinite(ref.lower[axis]) && std::isfinite(ref.upper[axis]) &&
               ref.lower[axis] <= ref.upper[axis];
    if (!finite) reject_domain(file, fmt::format("instance {} stands nowhere", i));
  }
}

}  // namespace

void reject_domain(const std::filesystem::path& file, const std::string& what) {
  throw Error("domain file is damaged: " + what + "; partition the scene again", {file.string()});
}

void check_structure(const DomainView& view, const std::filesystem::path& file) {
  if (!view.normals.empty() && view.normals.size() != view.clusters.size())
    reject_domain(file, "it does not have one group of normals a cluster");
  if (!view.uvs.empty() && view.uvs.size() != view.clusters.size())
    reject_domain(file, "it does not have one group of (u,v) a cluster");
  check_tree(file, view.nodes, view.clusters.size(), "cluster");
  check_tree(file, view.instance_nodes, view.instances.size(), "instance", true);
  check_instances(file, view.instances);
}

}  // namespace vitrail
