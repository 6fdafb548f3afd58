// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/geometry/vec.h"
#include "scene/shapes/quadric.h"

namespace vitrail {

// It holds values that a texture can read by name (Mitsuba's mesh attributes): `channels` floats a vertex or
// a face.
struct MeshAttribute {
  std::string name;  // "vertex_…" or "face_…"
  bool per_face = false;
  int channels = 3;  // 1 or 3; colours are linear sRGB
  std::vector<float> values;
  bool operator==(const MeshAttribute&) const = default;
};

// It names the attribute, one number a face, that says which face of Ptex's files a triangle belongs to.
// Without it all are of face 0, as in pbrt.
inline constexpr std::string_view face_indices = "face_indices";

// It gives the (u,v) of a triangle's three corners where the file gives none. `turned` is for triangles whose
// second and third corner have changed places since.
enum class MissingUv : std::uint8_t {
  pbrt,            // (0,0), (1,0), (1,1)
  pbrt_turned,     // (0,0), (1,1), (1,0)
  patches,         // of pbrt's bilinear patches, two triangles each: (0,0), (1,0), (1,1); (0,0), (1,1), (0,1)
  patches_turned,  // (0,0), (1,1), (1,0); (0,0), (0,1), (1,1)
  barycentric,     // (0,0), (1,0), (0,1): Mitsuba
  zero,            // (0,0) thrice
};

struct DeferredMesh;
class QuadricPlaces;

// It holds object-space triangles, or a quadric. `normals` and `uvs` are empty or have one entry a position.
// All indices are in range and all positions finite: importers guarantee it, with the place of the first
// offender.
struct TriangleMesh {
  std::vector<Point3f> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Normal3f> normals;  // shading normals, not necessarily unit length
  std::vector<Point2f> uvs;  // as the file gives them; a texture's mapping says where (0,0) is in its image
  MissingUv missing_uv = MissingUv::pbrt;  // also of a deferred mesh
  std::vector<MeshAttribute> attributes;
  std::shared_ptr<const DeferredMesh> deferred;  // if it stays in its file: all the rest is empty
  std::optional<Quadric> quadric;                // if it is one: all the rest is empty
  std::shared_ptr<const QuadricPlaces> places;   // of the quadric, if it stands in many
  bool operator==(const TriangleMesh&) const = default;
};

}  // namespace vitrail
