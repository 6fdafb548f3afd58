// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shapes/mesh.h"

namespace vitrail {

struct DecimatedMesh {
  TriangleMesh mesh;
  std::uint64_t asked = 0;       // triangles
  std::uint64_t degenerate = 0;  // triangles with two equal corners, which are left out
  bool manifold = true;          // if not, vertices where it is not are held
};

// Returns at least `fraction` of the triangles, chosen by quadric error (Garland and Heckbert 1997). An edge
// is collapsed into one of its ends, so that every vertex left is one of the mesh's, with its normal, uv and
// attributes. Seams, where those differ on the two sides of an edge, stay whole on both. Borders, which may
// meet another mesh, move by less than 1/1000 of their connected component's diagonal. Nothing moves by much
// more than 1/200 of it, or a twentieth of its thickness if closed (docs/why/meshes.md). So more than asked
// may be left. Normals that say no more than the triangles do are left out.
DecimatedMesh decimate(const TriangleMesh& mesh, double fraction);

}  // namespace vitrail
