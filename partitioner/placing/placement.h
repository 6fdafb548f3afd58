// SPDX-License-Identifier: Apache-2.0
// A Placement is one mesh where it stands in the world, with its triangles in the bundle's coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bundle/instance.h"
#include "partitioner/appearance/appearance.h"
#include "scene/geometry/bounds.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail {

using Triangle = std::array<Point3f, 3>;
using CornerNormals = std::array<std::uint32_t, 3>;  // encode_normal

// A Standing is where an object stands whose triangles are to be the scene's own.
struct Standing {
  Vector3d centre;  // of the object, whose coordinates are taken from there
  Affine to_bundle;
};

struct Placement {
  const TriangleMesh* mesh = nullptr;  // may be deferred
  const Shape* shape = nullptr;
  Transform to_world;                // or to the object's space
  bool flip = false;                 // the winding there shows the back
  std::uint64_t first_triangle = 0;  // global id, or the object's
  std::optional<Standing> standing = {};
  bool tube = false;  // of a curve: its opacity is that of both walls together
};

struct PlacedTriangles {
  std::vector<Triangle> triangles;     // wound so that the front is where they run counter-clockwise
  std::vector<CornerNormals> normals;  // empty, or one a triangle
  std::vector<CornerUvs> uvs;          // empty, or one a triangle
  std::vector<std::vector<CornerValues>>
      attributes;  // [slot][triangle] of the mesh attributes that textures read
};

// A PlacementRule says what is kept of the triangles. `offset` is taken from the world's coordinates.
struct PlacementRule {
  Vector3d offset;
  bool normals = false, uvs = false;
  std::span<const TextureBaker::Attribute> attributes;
};

// `outer` follows the shape's own transform. Where it mirrors, the front sides stay.
Placement placement_of(const TriangleMesh& mesh, const Shape& shape, const Transform& outer,
                       std::uint64_t first_triangle);

PlacedTriangles make_room(const PlacementRule& rule, std::uint64_t triangles);

// Places triangles of one mesh, composed in double, rounded once. Those that stand as an object does are
// rounded in the object's space and once more where it stands, as in tracing. Shading normals turn to their
// triangle's front; a triangle with one that is zero has none. What it is made of outlives it.
class MeshPlacer {
 public:
  // `mesh` is the placement's, loaded.
  MeshPlacer(const Placement& placement, const TriangleMesh& mesh, const PlacementRule& rule,
             const ReflectanceFitter& fitter);

  // Writes triangles [begin, end) of the mesh to `out` from `at` on. From any thread. Throws Error for
  // vertices that are not finite in the world.
  void place(std::size_t begin, std::size_t end, PlacedTriangles& out, std::uint64_t at) const;

 private:
  Triangle triangle(std::size_t i) const;
  CornerNormals normals(std::size_t i, const Triangle& placed) const;
  CornerUvs uvs(std::size_t i) const;
  CornerValues values(std::size_t i, const MeshAttribute& attribute,
                      const TextureBaker::Attribute& wanted) const;
  CornerValues tile_places(std::size_t i, const PtexTiles& tiles) const;
  [[noreturn]] void reject(std::size_t i) const;

  const Placement& placement_;
  const TriangleMesh& mesh_;
  const PlacementRule& rule_;
  const ReflectanceFitter& fitter_;
  std::vector<Point3f> vertices_;  // in the bundle's coordinates
};

// Places all triangles of the placement's mesh, which is loaded.
void place(const Placement& placement, const PlacementRule& rule, const ReflectanceFitter& fitter,
           PlacedTriangles& out, std::uint64_t at);

Surface surface_of(const Placement& placement, const Appearance& appearance);

}  // namespace vitrail
