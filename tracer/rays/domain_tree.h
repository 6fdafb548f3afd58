// SPDX-License-Identifier: Apache-2.0
// A scene's domains as the leaves of a tree for the kernels, so that a ray goes through all that are at hand
// as through one.
#pragma once

#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// The kd-tree, eight children to a node. A leaf is cluster_bit | domain; its box holds the boxes of the
// domain's own trees, so it leaves out no ray that these let in. Node 0 is the root. Empty domains are left
// out; no nodes where all are empty, or where there is one domain.
std::vector<BvhNode> domain_tree(const Manifest& manifest);

}  // namespace vitrail
