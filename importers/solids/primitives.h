// SPDX-License-Identifier: Apache-2.0
// These are shapes of the first and second degree, and the torus. Sizes that are not finite or leave nothing
// throw Error.
#pragma once

#include "importers/solids/solid.h"

namespace vitrail::solids {

// Makes a box from two opposite corners in any order.
Solid box(Point3d corner1, Point3d corner2);

Solid sphere(Point3d center, double radius, const Tessellation& tessellation = {});

// An `open` cone is without caps, which are then `unseen`. Either radius may be 0.
struct Cone {
  Point3d base_point;
  double base_radius = 1;
  Point3d cap_point;
  double cap_radius = 0;
  bool open = false;
};
Solid cone(const Cone& cone, const Tessellation& tessellation = {});
Solid cylinder(Point3d base_point, Point3d cap_point, double radius, bool open,
               const Tessellation& tessellation = {});

// The disc is flat and not closed. Its front is where the normal points.
Solid disc(Point3d center, Vector3d normal, double radius, double hole_radius,
           const Tessellation& tessellation = {});

// The torus is about the y axis, in the plane y = 0. A minor radius that is greater than the major one gives
// the outer surface.
Solid torus(double major, double minor, const Tessellation& tessellation = {});

// It is POV-Ray's egg about the y axis: a sphere about the origin, one about (0, bottom_radius, 0), and a
// lemon whose meridian has twice the greater radius and touches both. A top radius above twice the bottom one
// leaves the upper sphere.
Solid ovus(double bottom_radius, double top_radius, const Tessellation& tessellation = {});

// It is (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1 (Barr 1981). Both exponents are from 0.01 to 8: others
// are clamped.
Solid superellipsoid(double e, double n, const Tessellation& tessellation = {});

}  // namespace vitrail::solids
