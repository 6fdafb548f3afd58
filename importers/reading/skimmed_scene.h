// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/records/scene.h"

namespace vitrail {

// A scene as it is read but for the long lists, which are counted alone: meshes stand for so many triangles
// and cannot be loaded, and grids are empty.
struct SkimmedScene {
  Scene scene;
  std::uint64_t grid_bytes = 0;       // of the values of all grids
  std::uint64_t mesh_bytes = 0;       // of those with long lists or files of their own
  std::uint64_t sample_bytes = 0;     // of their triangles, where they stay in files (MeshMemory)
  std::uint64_t statement_bytes = 0;  // most that the reader holds while it reads one statement
};

}  // namespace vitrail
