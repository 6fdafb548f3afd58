// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "scene/shapes/mesh.h"

namespace vitrail {

// Returns a unit normal a vertex: of the triangles around it, weighted by their angles there (Thürmer and
// Wüthrich 1998), on the side where they run counter-clockwise. It is +x where there are none, or where they
// cancel.
std::vector<Normal3f> smooth_normals(const TriangleMesh& mesh);

// Returns the unit normal of a triangle, counter-clockwise, times its angle at each corner; 0 where it has no
// area.
std::array<Vector3d, 3> angle_weighted_normals(const std::array<Point3d, 3>& corners);

// Returns a sum of those at unit length, or +x where they cancel.
Normal3f unit_normal(const Vector3d& sum);

// Returns whether most shading normals point away from the side where the triangles run counter-clockwise.
bool normals_oppose_winding(const TriangleMesh& mesh);

// Returns whether a shading normal leans by more than `degrees` from that of its triangle, to either side.
bool normals_lean(const TriangleMesh& mesh, double degrees);

}  // namespace vitrail
