// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// Appends a node and what is below it, in preorder, and returns its number. `below` and `above` append theirs
// and return the references to them.
template <class Below, class Above>
std::uint32_t add_node(std::vector<KdNode>& nodes, KdNode node, const Below& below, const Above& above) {
  const std::size_t number = nodes.size();
  nodes.push_back(node);
  node.below = below();
  node.above = above();
  nodes[number] = node;
  return static_cast<std::uint32_t>(number);
}

}  // namespace vitrail
