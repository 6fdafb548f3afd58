// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shapes/mesh.h"

namespace vitrail {

// A unit normal a vertex: of the triangles around it, weighted by their angles there (Thürmer and Wüthrich
// 1998), on the side where they run counter-clockwise. +x where there are none, or where they cancel.
std::vector<Normal3f> smooth_normals(const TriangleMesh& mesh);

// Whether most shading normals point away from the side where the triangles run counter-clockwise.
bool normals_oppose_winding(const TriangleMesh& mesh);

// Whether a shading normal leans from that of a triangle by more than 14°, to either side.
bool normals_lean(const TriangleMesh& mesh);

}  // namespace vitrail
