// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "importers/obj/read/obj_parser.h"

namespace vitrail::obj {

// Gives the meshes of smooth groups a unit normal a vertex: of all triangles at its position that are in its
// smoothing group, whatever their materials and (u,v), weighted by their angles there. `meshes` has one for
// each group of the geometry.
void add_smooth_normals(const Geometry& geometry, std::vector<TriangleMesh>& meshes);

}  // namespace vitrail::obj
