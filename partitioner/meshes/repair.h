// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shapes/mesh.h"

namespace vitrail {

struct RepairedMesh {
  TriangleMesh mesh;
  // They count what was taken away: vertices that equal an earlier one in everything, vertices without a
  // triangle, triangles of zero area, and triangles with the corners of an earlier one.
  std::uint64_t merged_vertices = 0, unused_vertices = 0, degenerate_triangles = 0, duplicate_triangles = 0;
  bool operator==(const RepairedMesh&) const = default;
};

// Returns a soup without its defects. Nothing moves, and vertices that differ in a normal, uv or attribute
// stay apart. A triangle with the corners of an earlier one is its duplicate also if it faces the other way,
// unless `keep_opposite`: both may shine.
RepairedMesh repair(const TriangleMesh& mesh, bool keep_opposite);

}  // namespace vitrail
