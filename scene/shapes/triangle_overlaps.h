// SPDX-License-Identifier: Apache-2.0
// These functions find triangles that lie on one another.
#pragma once

#include <vector>

#include "scene/geometry/bounds.h"

namespace vitrail {

struct FlatTriangle {
  std::array<Point3d, 3> p;
  Vector3d normal;  // unit
  double area;
};

// Returns the triangle with its normal and area; where the area is 0, the normal is 0, too.
FlatTriangle flat_triangle(const std::array<Point3d, 3>& p);

// It names two triangles in one plane, as far as floats tell, and the area that both cover.
struct Overlap {
  std::uint32_t first, second;  // first < second
  double area;
};

// Returns all pairs whose common area is above 10⁻⁶ of the smaller one's. `complete` is false where so many
// are near one another that not all pairs were looked at.
std::vector<Overlap> overlaps_of(const std::vector<FlatTriangle>& triangles, bool& complete);

}  // namespace vitrail
