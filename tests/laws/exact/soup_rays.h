// SPDX-License-Identifier: Apache-2.0
// Rays that aim at what may go wrong in a soup cut into domains.
#pragma once

#include "tests/laws/exact/soup.h"

namespace vitrail::test {

// Random, through vertices and edges, in and beside interfaces, along axes, off triangles and cuts, grazing,
// from far away; of any length, with components that hardly differ from 0. All are finite and none is zero.
std::vector<Ray> rays_for(const Triangles& triangles, std::span<const KdNode> interfaces, double reach,
                          SoupRandom& random, std::size_t count);

}  // namespace vitrail::test
