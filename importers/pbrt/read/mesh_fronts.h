// SPDX-License-Identifier: Apache-2.0
// These functions settle which side of a mesh is its front.
#pragma once

#include "scene/records/scene.h"

namespace vitrail::pbrt {

// Turns triangles whose corner normals, summed, point away from their own normal. pbrt's fronts follow the
// normals. Returns whether the mesh would differ for the other `uvs_show`.
bool orient_by_normals(TriangleMesh& mesh, bool uvs_show = true);

// The first returns whether orient_by_normals would leave the mesh as it is. The second returns the mesh with
// its normals turned so that it would, or without them where a vertex has faces on both of its sides.
bool fronts_follow_normals(const TriangleMesh& mesh);
TriangleMesh with_normals_in_front(TriangleMesh mesh);

}  // namespace vitrail::pbrt
