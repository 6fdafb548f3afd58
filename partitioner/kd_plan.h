// SPDX-License-Identifier: Apache-2.0
// The kd-tree, or part of it, from the bounds of some of the triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bundle/manifest.h"
#include "partitioner/cut.h"

namespace vitrail {

// Part of the kd-tree to be made: `domains` from `first_domain` on, their inner nodes from `node` on. Nodes
// are numbered in preorder, so that every subtree knows its numbers beforehand and threads cannot change
// them.
struct Subtree {
  Bounds3f cell;
  std::uint32_t node = 0, first_domain = 0, domains = 1;
};

// Where to send triangles (`route`), and what is at the leaves.
struct KdPlan {
  std::vector<KdNode> nodes;
  std::vector<Subtree> leaves;
};

// Divides until no leaf has more than `most_domains`. `sample`: the bounds of triangles and pieces, of which
// all domains of the scene together have `share` times their number, each. No domain should have more
// than 1.2 times that. Writes the nodes that it makes to `kd_nodes`, the whole tree's. A cell in which
// nothing can be parted is halved: some of its domains stay empty.
KdPlan plan_kd_tree(std::vector<Bounds3f> sample, const Subtree& subtree, double share,
                    std::uint32_t most_domains, std::span<KdNode> kd_nodes);

}  // namespace vitrail
