// SPDX-License-Identifier: Apache-2.0
// How far vertices of glass may stand from where they were meant, as their file rounded them to decimals. A
// pane that is written so is a wedge of some 10⁻⁴ rad, which sunlight is to pass as a pane.
#pragma once

#include <span>
#include <unordered_map>

#include "bundle/manifest.h"
#include "partitioner/appearance/appearance.h"
#include "partitioner/placing/placement.h"

namespace vitrail {

// The coarsest step of decimals, a power of ten, that explains all coordinates: as many decimals (1.6235
// beside 0.9518), or six digits (as C's %g: 12.3457 beside 0.951844), by the greatest of them. 0: they are as
// fine as floats, or so coarse, a 64th of the mesh's extent, that they are a design and not its rounding.
double decimal_step(std::span<const Point3f> positions);

class VertexDoubts {
 public:
  // Outlived by it, and by the placements' meshes.
  explicit VertexDoubts(const Appearance& appearance);

  // Surface::vertex_doubt. 0 but of smooth glass where there is light whose connections ask for it: the
  // sun's, and other distant light. Loads the mesh if it is deferred.
  float of(const Placement& p);

 private:
  const Appearance& appearance_;
  bool wanted_ = false;
  std::unordered_map<const TriangleMesh*, double> steps_;
};

}  // namespace vitrail
