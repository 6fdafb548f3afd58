// SPDX-License-Identifier: Apache-2.0
// These functions say which domain a point belongs to. The cells of the kd-tree tile all of space. The first
// of several domains that share a cell has its points.
#pragma once

#include "bundle/manifest.h"

namespace vitrail {

// Visits the domains whose cells lie within `radius` of a point; with radius 0, the domain that has the
// point.
template <class Visit>
void for_each_domain_near(const Manifest& m, const float (&p)[3], double radius, const Visit& visit,
                          std::uint32_t from = 0) {
  std::uint32_t at = m.kd_nodes.empty() ? KdNode::leaf_bit : from;
  while (!(at & KdNode::leaf_bit)) {
    const KdNode& node = m.kd_nodes[at];
    if (node.axis == KdNode::no_axis) {
      at = node.below;
      continue;
    }
    const double to_plane = static_cast<double>(p[node.axis]) - static_cast<double>(node.split);
    const bool above = to_plane >= 0;
    if ((above ? to_plane : -to_plane) <= radius && radius > 0) {
      const std::uint32_t other = above ? node.below : node.above;
      if (other & KdNode::leaf_bit)
        visit(other & ~KdNode::leaf_bit);
      else
        for_each_domain_near(m, p, radius, visit, other);
    }
    at = above ? node.above : node.below;
  }
  visit(at & ~KdNode::leaf_bit);
}

inline std::uint32_t domain_of(const Manifest& m, const float (&p)[3]) {
  std::uint32_t domain = 0;
  for_each_domain_near(m, p, 0, [&](std::uint32_t d) { domain = d; });
  return domain;
}

}  // namespace vitrail
