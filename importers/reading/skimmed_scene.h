// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "scene/records/scene.h"

namespace vitrail {

// It is a scene as it is read but for the long lists, which are counted alone: meshes stand for so many
// triangles and cannot be loaded, and grids are empty.
struct SkimmedScene {
  Scene scene;
  std::uint64_t grid_bytes = 0;       // of the values of all grids
  std::uint64_t mesh_bytes = 0;       // of those with long lists or files of their own
  std::uint64_t sample_bytes = 0;     // of their triangles, where they stay in files (MeshMemory)
  std::uint64_t statement_bytes = 0;  // most that the reader holds while it reads one statement
};

// Returns a mesh that stands for one that was counted alone.
TriangleMesh counted_mesh(std::uint64_t triangles, std::uint64_t bytes, bool has_normals);

// Sets mesh_bytes and sample_bytes by the counted meshes of the scene.
void sum_up_meshes(SkimmedScene& skimmed);

// Returns a diffuse scene of counted meshes of so many triangles, which take `bytes` together: a file of bare
// geometry.
SkimmedScene skimmed_model(std::span<const std::uint64_t> triangles, std::uint64_t bytes, bool has_normals);

}  // namespace vitrail
