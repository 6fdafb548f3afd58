// SPDX-License-Identifier: Apache-2.0
// This file tells how far vertices of glass may be from where they were meant, since their file rounded
// decimals. A pane that is written so is a wedge of some 10⁻⁴ rad, which sunlight is to pass as a pane.
#pragma once

#include <span>
#include <unordered_map>

#include "bundle/manifest.h"
#include "partitioner/appearance/appearance.h"
#include "partitioner/placing/placement.h"

namespace vitrail {

// Returns the coarsest step, a power of ten, that explains all coordinates: equal decimals (1.6235
// beside 0.9518), or six digits (as C's %g: 12.3457 beside 0.951844), by the greatest of them. It
// is 0 where they are as fine as floats, or so coarse, a 64th of the mesh's extent, that they are
// a design and not its rounding.
double decimal_step(std::span<const Point3f> positions);

class VertexDoubts {
 public:
  // The appearance outlives it, and so do the placements' meshes.
  explicit VertexDoubts(const Appearance& appearance);

  // Returns Surface::vertex_doubt. It is 0 but for smooth glass where there is light whose connections ask
  // for it: the sun's, and other distant light. Loads the mesh if it is deferred.
  float of(const Placement& p);

 private:
  const Appearance& appearance_;
  bool wanted_ = false;
  std::unordered_map<const TriangleMesh*, double> steps_;
};

}  // namespace vitrail
