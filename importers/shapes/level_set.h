// SPDX-License-Identifier: Apache-2.0
// This file finds the zero level of a function on a grid.
#pragma once

#include <vector>

#include "scene/shapes/mesh.h"

namespace vitrail {

// It has values at the corners of (nx−1)(ny−1)(nz−1) cells that fill [0,1]³, x fastest; each count is at
// least 2.
struct SampledFunction {
  int nx = 0, ny = 0, nz = 0;
  std::vector<float> values;
};

// It is the surface where the trilinear interpolation is 0, as triangles: those of a finer grid cut into
// tetrahedra (Doi and Koide 1991), which share their vertices. Fronts and normals look to where the function
// grows; normals are those of central differences over one cell. `distance` is the greatest of the triangles'
// middles from the surface, by value ÷ gradient.
struct LevelSet {
  TriangleMesh mesh;
  double distance = 0;
};
LevelSet level_set(const SampledFunction& function);

}  // namespace vitrail
