// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vitrail {

// Counts the lines of an OBJ file by their first words. Polygons count as the triangles that they become;
// lines that a backslash joins count as one. Nothing is checked. Throws Error where the file cannot be read.
struct ObjCounts {
  std::uint64_t positions = 0, uvs = 0, normals = 0, triangles = 0, corners = 0;
  std::vector<std::uint64_t> parts;  // triangles between two lines of o, g or usemtl, where there are some
};
ObjCounts count_obj(const std::filesystem::path& file);

}  // namespace vitrail
