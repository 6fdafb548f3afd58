// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "partitioner/meshes/vertices.h"

namespace vitrail {

// Returns for each closed component (the numbers of its triangles) in how many of the others it lies:
// strictly, with all its vertices, by exact predicates. Components are consistently oriented manifolds over
// the vertices of `triangles`; `positions` are those of the vertices.
std::vector<int> nesting_depths(const std::vector<Point3f>& positions, const std::vector<Triangle>& triangles,
                                const std::vector<std::vector<std::uint32_t>>& components);

}  // namespace vitrail
