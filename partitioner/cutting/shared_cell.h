// SPDX-License-Identifier: Apache-2.0
// This is a ray's way through a cell that several domains share, each with some of the instances in it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// A SharedBox is a box of something that one of the domains has.
struct SharedBox {
  Bounds3f box;
  std::uint32_t domain = 0;
};

// Returns a kd-tree of small cells, so that a ray comes first to the domains that have something where it
// enters. A leaf is leaf_bit | domain, as often as the domain is met, and leaf_bit | `none` where there is
// nothing. Planes beside what a domain has in a small cell part it from the rest. It has `most_depth` levels
// at most, and none where one box or one domain is all.
std::vector<KdNode> tree_of_shared(const Bounds3f& cell, std::span<const SharedBox> boxes, std::uint32_t none,
                                   int most_depth);

}  // namespace vitrail
