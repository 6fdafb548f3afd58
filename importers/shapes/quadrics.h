// SPDX-License-Identifier: Apache-2.0
// These functions make quadrics as files say them. They throw Error for sizes that are not finite or leave
// nothing (radius ≤ 0, inner radius ≥ radius, zmin = zmax, phimax ≤ 0).
#pragma once

#include "scene/geometry/transform.h"
#include "scene/shapes/mesh.h"

namespace vitrail {

TriangleMesh mesh_of(const Quadric& quadric);

struct SizedQuadric {
  Quadric quadric;
  Transform to_object;
};

// It sorts zmin and zmax and clamps them to ±radius; it clamps phimax to 2π.
SizedQuadric sphere(double radius, double zmin, double zmax, double phimax_rad);
// The disk lies in the plane z = height.
SizedQuadric disk(double height, double radius, double inner_radius, double phimax_rad);
// The cylinder has no caps; zmin and zmax are sorted.
SizedQuadric cylinder(double radius, double zmin, double zmax, double phimax_rad);
// The cone goes from the circle at z = 0 to the apex at z = height.
SizedQuadric cone(double radius, double height, double phimax_rad);
// The surface is z = zmax·(r/radius)² between zmin and zmax, which are sorted.
SizedQuadric paraboloid(double radius, double zmin, double zmax, double phimax_rad);

// Returns the area of the quadric where an affine transform puts it, by quadrature: to 1e-12 where its axes
// stay perpendicular and those of x and y equal, and to 1e-6 elsewhere.
double area_of(const Quadric& quadric, const Transform& to);

}  // namespace vitrail
