// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "scene/shapes/mesh.h"

namespace vitrail {

// A Subdivision is a scheme over positions and triangles alone. Each of `levels` makes four triangles of
// each, in the order of theirs, with normals. `corners` has one entry a triangle: where its corners lie in
// the triangle that it comes from, in that one's barycentric coordinates of its second and third corner.
using Subdivision = std::function<TriangleMesh(const TriangleMesh& cage, int levels,
                                               std::vector<std::array<Point2d, 3>>& corners)>;

struct SubdividedMesh {
  TriangleMesh mesh;
  std::uint64_t degenerate = 0;  // triangles with two equal corners, which are left out
  bool manifold = true;          // if not, it is parted where it is not, with borders there
};

// Seams stay closed: positions are subdivided as one surface; uvs and attributes are linear in each triangle.
SubdividedMesh subdivide(const TriangleMesh& mesh, int levels, const Subdivision& scheme);

}  // namespace vitrail
