// SPDX-License-Identifier: Apache-2.0
// One mesh written in every form that is measured.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::bench {

struct MeshFile {
  std::string form;
  std::filesystem::path path;
  bool bare = false;  // positions and triangles alone
};

// A rippled sphere of about `triangles` triangles with a seam of texture coordinates, in `folder`: PBRT text,
// binary PLY of both byte orders, ASCII PLY, and OBJ, where "obj" has one index a corner and "obj, seam"
// shares positions and normals across the seam, as modellers write it. Files that are there already are kept.
std::vector<MeshFile> write_mesh_files(const std::filesystem::path& folder, std::uint32_t triangles);

}  // namespace vitrail::bench
