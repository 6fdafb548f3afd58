// SPDX-License-Identifier: Apache-2.0
// These functions make triangle meshes of pbrt's patches and subdivision surfaces, in object space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// Makes a mesh of pbrt's bilinear patches. A patch has four indices: the corners at (u,v) = (0,0), (1,0),
// (0,1), (1,1). `normals` and `uvs` are empty or have one entry a position; without uvs each patch is the
// unit square. Patches become two triangles each, as MissingUv::patches has them, where that shows neither in
// their surface nor, if `uvs_show`, in where a texture lies: by no more than 2e-4 of a patch's diagonal or
// 2e-5 of half the mesh's. Else all become n×n grids that are as close, as far as the mesh stays below eight
// million triangles and n ≤ 64; curved ones have their own normals where none are given.
TriangleMesh tessellate_bilinear(const std::vector<Point3f>& positions,
                                 const std::vector<std::array<std::uint32_t, 4>>& patches,
                                 const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs,
                                 bool uvs_show = true);

// Subdivides by Loop's scheme (Loop 1987) with the weights of Warren (1995), which pbrt uses; boundary edges
// stay boundaries (cubic B-spline). Vertices are then moved to the limit surface and carry its normals.
// Vertices of the cage without a face, and its own normals and uvs, are left out. A cage that is not a
// consistently oriented manifold throws Error. A triangle becomes 4^levels neighbours in the order of the
// cage's; for their corners `parameters` gets the barycentric coordinates of its second and third corner.
TriangleMesh loop_subdivide(const TriangleMesh& cage, int levels,
                            std::vector<std::array<Point2d, 3>>* parameters = nullptr);

}  // namespace vitrail
