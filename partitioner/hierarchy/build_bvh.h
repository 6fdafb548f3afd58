// SPDX-License-Identifier: Apache-2.0
// This file builds the 8-wide BVH over a domain's boxes.
#pragma once

#include <span>
#include <vector>

#include "bundle/domain_file.h"

namespace vitrail {

// Node 0 is the root; a node comes before its children, which keep their order; so do leaves,
// which are the clusters of `nodes`.
struct BoxTree {
  std::vector<BvhNode> nodes;
  std::vector<std::uint32_t> leaves;  // [leaf · leaf_size + lane]: a box, ascending in a leaf, or no_triangle
};

// Builds a binary tree by the surface area heuristic, collapsed to 8-wide nodes of least SAH cost. A box of
// the tree bounds its content, inflated on every side by 10⁻⁶|x|. The result depends neither on the number of
// threads nor on the machine. No boxes give no nodes.
BoxTree build_bvh(std::span<const Bounds3f> boxes, unsigned leaf_size);

// Builds the same with a leaf for each box, BvhNode::cluster_bit | its position.
std::vector<BvhNode> build_tree(std::span<const Bounds3f> boxes);

// Returns a box moved by padding + 10⁻⁶|x| on every side.
Bounds3f inflated(const Bounds3f& box, double padding);
double greatest(const Bounds3f& box);  // |coordinate|; 0 where empty

}  // namespace vitrail
