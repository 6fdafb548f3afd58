// SPDX-License-Identifier: Apache-2.0
#include "tracer/rays/cell_ways.h"

#include <algorithm>

namespace vitrail {

CellWays::CellWays(const Manifest& manifest)
    : cells_(manifest.domains.size(), {KdNode::leaf_bit, none}), above_(manifest.kd_nodes.size(), none) {
  const auto enter = [&](std::uint32_t reference, std::uint32_t above) {
    if (reference & KdNode::leaf_bit) {
      cells_[reference & ~KdNode::leaf_bit] = {reference, above};
      return false;
    }
    above_[reference] = above;
    const KdNode& node = manifest.kd_nodes[reference];
    if (node.axis != KdNode::no_axis) return true;
    const std::uint32_t first = node.below & ~KdNode::leaf_bit;
    std::fill_n(cells_.begin() + first, static_cast<std::size_t>(node.split), Cell{reference, above});
    return false;
  };
  std::vector<std::uint32_t> open;
  if (!manifest.kd_nodes.empty() && enter(0, none)) open.push_back(0);
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    for (const std::uint32_t child : {manifest.kd_nodes[at].below, manifest.kd_nodes[at].above})
      if (enter(child, at)) open.push_back(child);
  }
}

}  // namespace vitrail
