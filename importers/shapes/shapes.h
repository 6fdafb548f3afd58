// SPDX-License-Identifier: Apache-2.0
// Triangle meshes of pbrt's analytic shapes, in object space, with exact normals and pbrt's (u,v).
//
// Vertices lie on the true surface, so convex shapes come out slightly small. A full turn takes so many
// segments:
//   sphere              224 (and 112 from pole to pole): distance ≤ 2.0e-4·radius; area −1.3e-4, volume
//   −2.6e-4 (relative) disk and cylinder   512: distance ≤ 1.9e-5·radius; area of a disk, volume of a
//   cylinder −2.5e-5, area of a cylinder −6.3e-6
// A part of a turn takes the same share of them, rounded up.
// Sides: the front is outside for spheres and cylinders, +z for disks, (p10−p00)×(p01−p00) for bilinear
// patches. Where a shape closes on itself (poles, seam), positions there agree bit for bit. Sizes that are
// not finite or leave nothing (radius ≤ 0, inner radius ≥ radius, zmin = zmax, phimax ≤ 0) throw Error.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace vitrail {

inline constexpr int sphere_segments = 224;
inline constexpr int disk_segments = 512;
inline constexpr int cylinder_segments = 512;

// About z, angle φ = u·phimax from +x towards +y; v is linear in the polar angle from zmin to zmax, which are
// sorted and clamped to ±radius. phimax is clamped to 2π.
TriangleMesh tessellate_sphere(double radius, double zmin, double zmax, double phimax_rad);

// In the plane z = height; u as above, v = 0 at the outer and 1 at the inner edge.
TriangleMesh tessellate_disk(double height, double radius, double inner_radius, double phimax_rad);

// Without caps; u as above, v = 0 at zmin and 1 at zmax, which are sorted.
TriangleMesh tessellate_cylinder(double radius, double zmin, double zmax, double phimax_rad);

// pbrt-v3's, without caps, u as above: from the circle at z = 0 (v = 0) to the apex at z = height; and
// z = zmax·(r/radius)² between zmin and zmax, which are sorted, v linear in z. The front is outside.
TriangleMesh tessellate_cone(double radius, double height, double phimax_rad);
TriangleMesh tessellate_paraboloid(double radius, double zmin, double zmax, double phimax_rad);

// pbrt's bilinear patches. Four indices a patch: the corners at (u,v) = (0,0), (1,0), (0,1), (1,1). `normals`
// and `uvs` are empty or have one entry a position; without uvs each patch is the unit square. Patches become
// two triangles each, as MissingUv::patches has them, where that shows neither in their surface nor, if
// `uvs_show`, in where a texture lies: by no more than 2e-4 of a patch's diagonal or 2e-5 of half the mesh's.
// Else all become n×n grids that are as close, as far as the mesh stays below eight million triangles and
// n ≤ 64; curved ones with their own normals where none are given.
TriangleMesh tessellate_bilinear(const std::vector<Point3f>& positions,
                                 const std::vector<std::array<std::uint32_t, 4>>& patches,
                                 const std::vector<Normal3f>& normals, const std::vector<Point2f>& uvs,
                                 bool uvs_show = true);

// Loop's subdivision (Loop 1987) with the weights of Warren (1995), which pbrt uses; boundary edges stay
// boundaries (cubic B-spline). Vertices are then moved to the limit surface and carry its normals. Vertices
// of the cage without a face, and its own normals and uvs, are left out. A cage that is not a consistently
// oriented manifold throws Error. A triangle's become 4^levels neighbours in the order of the cage's; for
// their corners `parameters` gets the barycentric coordinates of its second and third corner.
TriangleMesh loop_subdivide(const TriangleMesh& cage, int levels,
                            std::vector<std::array<Point2d, 3>>* parameters = nullptr);

}  // namespace vitrail
