// SPDX-License-Identifier: Apache-2.0
// A KdPlan is the kd-tree, or part of it, made from the bounds of some of the triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bundle/manifest.h"
#include "partitioner/cutting/choose_plane.h"

namespace vitrail {

// A Subtree is part of the kd-tree to be made: `domains` from `first_domain` on, their inner nodes
// from `node` on. Nodes are numbered in preorder, so that every subtree knows its numbers beforehand
// and threads cannot change them.
struct Subtree {
  Bounds3f cell;
  std::uint32_t node = 0, first_domain = 0, domains = 1;
  int depth = 0;  // planes above it
};

struct PlanRule {
  double share = 0;                // of the work of the whole scene's sample, that a domain should have
  std::uint32_t most_domains = 1;  // in a leaf of the plan, which has half as many at least where it can
  bool median = false;             // median_plane decides, for comparison
  double rate = 1;                 // of the items, how many are in the sample
};

// A KdPlan says where to send triangles (`route`), and what is at the leaves.
struct KdPlan {
  std::vector<KdNode> nodes;
  std::vector<Subtree> leaves;
  std::vector<std::size_t> samples;  // in each leaf
};

// Divides until no leaf has more than `most_domains`. `sample` has the cell's items. No domain should have
// more than 1.2 times its share of them. Writes the nodes that it makes to `kd_nodes`, the whole tree's. A
// cell in which nothing can be parted is halved: some of its domains stay empty. A cell stays whole if its
// items are mostly pieces, of which the best plane would cut more than it parts. It is then a leaf of several
// domains, of which the first has all; its node in `kd_nodes` has this domain on both sides.
KdPlan plan_kd_tree(std::vector<Item> sample, const Subtree& subtree, const PlanRule& rule,
                    std::span<KdNode> kd_nodes);

// The domains of a SharedCell share it, since the objects in it do not fit into memory together.
struct SharedCell {
  std::uint32_t domain = 0;            // of the plan: it has the cell's triangles and points
  std::vector<std::uint32_t> numbers;  // of the others until all are numbered: beyond the plan's
  std::vector<DomainInfo> infos;       // theirs
  std::vector<KdNode> tree;  // a leaf is one of the others, or `domain` as their count; empty: there is one
};

// Takes the domains out of the manifest that are not there because a cell stayed whole. Puts in those that
// share a cell, behind the plan's, and numbers all anew. Returns the old number of each.
std::vector<std::uint32_t> number_domains(Manifest& manifest, std::vector<SharedCell> shared);

}  // namespace vitrail
