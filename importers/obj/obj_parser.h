// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "importers/ply/input_bytes.h"
#include "scene/scene.h"

namespace vitrail::obj {

// The triangles of one material that have texture coordinates and normals, or have not.
struct Group {
  std::size_t material = 0;
  bool has_uvs = false, has_normals = false;
  // For each corner the index of its position, then of its uv and of its normal where the group has them.
  std::vector<std::uint32_t> corners;
  std::size_t indices_a_corner() const { return 1u + (has_uvs ? 1 : 0) + (has_normals ? 1 : 0); }
};

// A name in the file and where it stands first.
struct Mention {
  std::string name;
  SourceLocation location;
};

struct Geometry {
  std::vector<Point3d> positions;
  std::vector<Point2f> uvs;
  std::vector<Normal3f> normals;
  std::vector<Group> groups;       // in the order of their first face
  std::vector<Mention> materials;  // of usemtl; the first stands for faces without one
  std::vector<Mention> libraries;  // what follows each mtllib
  Diagnostics diagnostics;
};

// Reads a file whose indices count from `base`, which is 1 or 0. False if it is 1 and a face has vertex index
// 0. Throws Error.
bool parse(InputBytes& bytes, const std::string& file, int base, Geometry& geometry);

}  // namespace vitrail::obj
