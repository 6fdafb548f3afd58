// SPDX-License-Identifier: Apache-2.0
// These functions make pbrt's meshes of the faces of a PLY file.
#pragma once

#include "importers/pbrt/read/version.h"
#include "importers/ply/read/ply.h"

namespace vitrail::pbrt {

PbrtQuads quads_of(Version version);

struct PlyMesh {
  TriangleMesh mesh;
  std::size_t parts = 0;     // triangles or patches
  bool tessellated = false;  // of curved patches
};

// Returns the mesh of the triangles and that of the patches: at least one of them. Fronts follow the normals.
// `faces_show` says whether their numbers are kept. `differs`, if given, gets whether the result depends on
// `uvs_show` and `faces_show`.
std::vector<PlyMesh> meshes_of(PbrtPly ply, bool uvs_show, bool faces_show, bool* differs = nullptr);

// Gives a mesh that was made of so many faces their face_indices: each has as many of the triangles.
void add_face_indices(TriangleMesh& mesh, const std::vector<float>& faces);

}  // namespace vitrail::pbrt
