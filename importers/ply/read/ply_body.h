// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "importers/ply/read/ply.h"
#include "importers/ply/read/ply_header.h"
#include "scene/records/scene.h"

namespace vitrail::ply {

// It says which property of the vertex element has each of x y z, nx ny nz, u v. The first three are always
// set, the others as complete groups or not at all.
struct VertexLayout {
  static constexpr std::size_t slots = 8, first_normal = 3;
  std::array<std::optional<std::size_t>, slots> property;
  bool has_normals() const { return property[3].has_value(); }
  bool has_uvs() const { return property[6].has_value(); }
};

struct BodyPlan {
  std::size_t vertex_element = 0;
  VertexLayout vertex;
  // They are faces or strips of triangles; a file may have both.
  struct Faces {
    std::size_t element = 0;
    std::size_t corner_list = 0;  // property of the element
  };
  std::optional<Faces> faces, strips;
};

struct Body {
  TriangleMesh mesh;
  std::optional<PbrtQuads> quads;  // else they are polygons as others are
  std::vector<std::array<std::uint32_t, 4>> patches;
  std::vector<float> patch_faces;   // their face_indices, or empty
  std::uint64_t dropped_faces = 0;  // with fewer than three corners
  std::uint64_t polygons = 0;       // with more than four
  std::uint64_t lost_numbers = 0;   // of normals, (u,v) and attributes: not finite in the file, 0 in the mesh
};

// Reads the body, at whose first byte `cursor` stands.
Body read_body(const InputBytes& bytes, const TextCursor& cursor, const Header& header, const BodyPlan& plan,
               std::optional<PbrtQuads> quads = {});

}  // namespace vitrail::ply
