// SPDX-License-Identifier: Apache-2.0
// CGAL's exact predicates decide here: no rounding changes the answers.
#pragma once

#include "scene/geometry/vec.h"
#include "scene/shapes/mesh.h"

namespace vitrail {

// Returns whether the area is zero: two corners are equal, or all three on a line.
bool is_degenerate(Point3f a, Point3f b, Point3f c);

// Returns the sign of the volume that a closed surface bounds: +1 where its triangles run counter-clockwise
// seen from outside. `triangles` are numbers of triangles of the mesh.
int volume_sign(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles);

}  // namespace vitrail
