// SPDX-License-Identifier: Apache-2.0
// Quadrics as files say them. Sizes that are not finite or leave nothing (radius ≤ 0, inner radius ≥ radius,
// zmin = zmax, phimax ≤ 0) throw Error.
#pragma once

#include "scene/geometry/transform.h"
#include "scene/shapes/mesh.h"

namespace vitrail {

TriangleMesh mesh_of(const Quadric& quadric);

struct SizedQuadric {
  Quadric quadric;
  Transform to_object;
};

// zmin and zmax are sorted and clamped to ±radius, phimax is clamped to 2π.
SizedQuadric sphere(double radius, double zmin, double zmax, double phimax_rad);
// In the plane z = height.
SizedQuadric disk(double height, double radius, double inner_radius, double phimax_rad);
// Without caps; zmin and zmax are sorted.
SizedQuadric cylinder(double radius, double zmin, double zmax, double phimax_rad);
// From the circle at z = 0 to the apex at z = height.
SizedQuadric cone(double radius, double height, double phimax_rad);
// z = zmax·(r/radius)² between zmin and zmax, which are sorted.
SizedQuadric paraboloid(double radius, double zmin, double zmax, double phimax_rad);

// Where an affine transform puts it; by quadrature, to 1e-12 where its axes stay perpendicular and those of x
// and y equal, and to 1e-6 elsewhere.
double area_of(const Quadric& quadric, const Transform& to);

}  // namespace vitrail
