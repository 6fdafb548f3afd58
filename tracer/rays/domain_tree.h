// SPDX-License-Identifier: Apache-2.0
// This tree for the kernels has a scene's domains as its leaves, so that a ray goes through all that are at
// hand as through one.
#pragma once

#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// Returns the kd-tree with eight children to a node. A leaf is cluster_bit | domain. Its box holds the boxes
// of the domain's own trees, so it leaves out no ray that these let in. Node 0 is the root. Empty domains are
// left out. There are no nodes where all domains are empty, or where there is one domain.
std::vector<BvhNode> domain_tree(const Manifest& manifest);

}  // namespace vitrail
