// SPDX-License-Identifier: Apache-2.0
// Decisions by CGAL's exact predicates: no rounding turns them.
#pragma once

#include "scene/geometry/vec.h"
#include "scene/shapes/mesh.h"

namespace vitrail {

// Zero area: two corners are equal, or all three on a line.
bool is_degenerate(Point3f a, Point3f b, Point3f c);

// The sign of the volume that a closed surface bounds: +1 where its triangles run counter-clockwise seen from
// outside. `triangles` are numbers of triangles of the mesh.
int volume_sign(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles);

}  // namespace vitrail
