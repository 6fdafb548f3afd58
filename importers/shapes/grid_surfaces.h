// SPDX-License-Identifier: Apache-2.0
// These surfaces of pbrt-v3 are grids of triangles over (u,v), whose fronts are where dp/du × dp/dv points.
#pragma once

#include <array>
#include <vector>

#include "scene/shapes/mesh.h"

namespace vitrail {

// Returns a surface over the unit square of the xy plane: columns × rows heights, a row of x after the other.
// (u,v) = (x,y).
TriangleMesh heightfield(int columns, int rows, const std::vector<double>& heights);

// Returns the surface that a line from p1 (v = 0) to p2 (v = 1) sweeps as it turns about the z axis by phimax
// (u = 1). A full turn has 256 × 64 cells, with the surface's normals. As in pbrt-v3 the waist is at z = 0,
// though the line may be nearest to the axis elsewhere. The points keep their angles and heights, and get the
// distance from the axis that a(x² + y²) − cz² = 1 has there. Normals are the line's.
// Where p2 is at z = 0, p1 and p2 change places.
TriangleMesh hyperboloid(Vector3d p1, Vector3d p2, double phimax_rad);

// It is one direction of a B-spline (Cox 1972, de Boor 1972): degree + 1, the knots, and the part that is
// shown.
struct Spline {
  int points = 0, order = 0;
  std::vector<double> knots;
  double begin = 0, end = 0;
};

// Makes a rational surface from points (wx, wy, wz, w), a row of u after the other, on the 30 × 30 grid of
// triangles that pbrt-v3 makes of it. (u,v) are the parameters. Throws Error for splines whose knots descend
// or are not points + order, whose order is below 2 or above their points, or that are shown beyond their
// knots.
TriangleMesh nurbs(const Spline& u, const Spline& v, const std::vector<std::array<double, 4>>& points);

}  // namespace vitrail
