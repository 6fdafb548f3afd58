// SPDX-License-Identifier: Apache-2.0
// These functions find which triangles hang together, and whether they enclose anything.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/geometry/transform.h"
#include "scene/shapes/mesh.h"

namespace vitrail {

// It places a mesh in a space that it shares with others.
struct PlacedMesh {
  const TriangleMesh* mesh;  // neither deferred nor a quadric
  Transform to_space;
};

struct MeshTriangle {
  std::uint32_t mesh, triangle;
};

// It consists of triangles that edges join, by the positions of their vertices: seams of normals and (u,v)
// part nothing, nor does a change of mesh.
struct MeshPart {
  enum class Kind : std::uint8_t {
    closed,   // as far as holes and cracks go, which are less than 1/1000 of its area
    open,     // it has a rim, or holes of more than that: a single face, a dome, a tube
    folded,   // closed, but around nothing: each face has another one on its back
    rimless,  // open, and together with another such part the two faces of a sheet without its rim
  };
  Kind kind = Kind::closed;
  std::vector<MeshTriangle> triangles;
  std::vector<MeshTriangle> doubles;  // again in one place, with either winding; the first is in `triangles`
  double area = 0, open_area = 0;     // of its faces and of its holes
  Point3d centre;
  Vector3d facing;  // sum of the areas of its faces along their normals
};

std::vector<MeshPart> parts_of(std::span<const PlacedMesh> meshes);

// Returns the mesh of these of its triangles, with all attributes. Vertices keep their order; those that none
// uses are left out.
TriangleMesh only_triangles(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles);

}  // namespace vitrail
