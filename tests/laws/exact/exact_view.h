// SPDX-License-Identifier: Apache-2.0
// One triangle as a ray sees it, in CGAL's rational numbers: what exact_hit works out in double. Nothing of
// it is shared with the tracer.
#pragma once

#include "tests/partitioner/hierarchy/clustered_mesh.h"

namespace vitrail::test {

// The ray runs along z, its greatest component, through 0; vertices are sheared so. Everything is exact but
// for one rounding of each number at the end.
struct ExactView {
  double x[3], y[3], z[3];  // of the vertices
  double edge[3];           // edge functions
  double det;               // their sum
  double zeta;              // where the ray meets the plane, t·|d_z|; meaningless where det is 0
  bool crossed;             // the closed triangle, which has area as the ray sees it
};
ExactView exact_view(const Ray& ray, const Triangle& triangle);

// How far from 0 the triangle (x, y) is.
double distance_aside(const ExactView& view);

}  // namespace vitrail::test
