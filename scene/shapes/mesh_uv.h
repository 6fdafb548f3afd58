// SPDX-License-Identifier: Apache-2.0
// These functions give the (u,v) of meshes, given in the file or not.
#pragma once

#include "scene/shapes/mesh.h"

namespace vitrail {

using CornerUvs = std::array<Point2f, 3>;

// Returns the (u,v) of a triangle of a mesh without its own.
CornerUvs missing_uvs(MissingUv rule, std::size_t triangle);

// Returns the (u,v) of a triangle of a mesh that is loaded.
CornerUvs uvs_of(const TriangleMesh& mesh, std::size_t triangle);

// Returns the mesh with (u,v) of its own; if it had none, no two triangles share a vertex.
TriangleMesh with_uvs(TriangleMesh mesh);

// Exchanges the second and the third corner of all triangles. Their (u,v) stay where they are, if they show.
void turn_round(TriangleMesh& mesh, bool uvs_show = true);

}  // namespace vitrail
