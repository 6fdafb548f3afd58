// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "partitioner/meshes/vertices.h"

namespace vitrail {

// A MeshSurface has a mesh's triangles as a manifold, consistently oriented surface. They are joined along
// an edge where exactly two triangles have it, in opposite directions, and at a vertex only around
// such edges. Seams do not part it.
struct MeshSurface {
  std::vector<std::uint32_t>
      sources;                      // of each triangle in the mesh; those with two equal corners are left out
  std::vector<Triangle> triangles;  // over the vertices below
  std::vector<Triangle> wedges;     // the mesh's vertices at the corners, equal ones by their first
  std::vector<std::uint32_t> points;  // of a vertex: the first of the mesh's vertices that lie there
  std::vector<bool> held;  // of a vertex: where the mesh is no such surface; moving one would tear it
  bool is_manifold() const;
};

MeshSurface surface_of(const TriangleMesh& mesh);

}  // namespace vitrail
