// SPDX-License-Identifier: Apache-2.0
// Julia sets in four dimensions are cut by a hyperplane.
#pragma once

#include <array>

#include "importers/solids/solid.h"

namespace vitrail::solids {

// A point is inside where h ← f(h) + parameter stays within |h| = 4 for max_iteration steps, of hypercomplex
// numbers one step less (measured in pictures of povray 3.7). (x, y, z) are the first three coordinates of h.
// The fourth puts h on the slice: dot(normal, h) = distance.
struct JuliaFractal {
  enum class Function { square, cube };
  std::array<double, 4> parameter{};
  bool hypercomplex = false;  // else quaternions
  Function function = Function::square;
  int max_iteration = 20;
  std::array<double, 4> slice_normal{0, 0, 0, 1};  // the fourth is not 0, or Error
  double slice_distance = 0;
};
// Makes the set within the sphere of radius 2 about the origin.
Solid julia_fractal(const JuliaFractal& fractal, const Tessellation& tessellation = {});

}  // namespace vitrail::solids
