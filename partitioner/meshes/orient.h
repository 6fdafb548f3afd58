// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shapes/mesh.h"

namespace vitrail {

enum class Facing {
  outward,     // closed components: counter-clockwise seen from outside
  inward,      // clockwise
  consistent,  // like the greater part of their area
};

struct OrientedMesh {
  TriangleMesh mesh;
  std::uint64_t turned_triangles = 0;
  std::uint64_t components = 0, closed_components = 0;
  std::uint64_t inner_components =
      0;  // closed ones that bound a hollow of another: they are turned the other way
};

// Turns the triangles of each connected component to one side. A closed one turns as asked, by the exact sign
// of its volume; others, and those of volume 0, as `consistent`. Where more than two triangles meet at an
// edge they do not decide on one another. Shading normals are turned to the triangles' fronts, the three of a
// triangle together; vertices that would have to face both ways are doubled, at the end.
OrientedMesh orient(const TriangleMesh& mesh, Facing sides);

}  // namespace vitrail
