// SPDX-License-Identifier: Apache-2.0
// pbrt's quadrics. Sizes that are not finite or leave nothing (radius ≤ 0, inner radius ≥ radius, zmin =
// zmax, phimax ≤ 0) throw Error.
#pragma once

#include "scene/quadric.h"

namespace vitrail {

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

}  // namespace vitrail
