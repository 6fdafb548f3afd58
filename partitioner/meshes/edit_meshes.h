// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "partitioner/meshes/subdivide.h"
#include "scene/records/scene.h"

namespace vitrail {

// MeshEdits are made to every mesh, in this order.
struct MeshEdits {
  bool repair = false, orient = false;
  int subdivide = 0;    // levels
  double decimate = 1;  // fraction of the triangles to keep
  Subdivision scheme;   // asked for where subdivide > 0
  bool any() const { return repair || orient || subdivide > 0 || decimate < 1; }
};

struct EditedMeshes {
  Diagnostics notes;  // what was done to which mesh, at the first shape that uses it
  std::uint64_t triangles_before = 0, triangles_after = 0;  // of meshes in use, each counted once
};

struct MeshResources {
  static constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t kept_bytes = unlimited;      // of meshes in memory, as for MeshMemory
  std::uint64_t resident_bytes = unlimited;  // most memory of this process
  int threads = 0;                           // 0: one a processor allowed
};

// Edits meshes in memory in parallel, as far as they fit. Meshes in files come one after the other; they stay
// there if they are still too large, and are edited anew whenever they are loaded. Meshes that shine keep
// their fronts (`orient` makes them consistent) and triangles that face opposite ways. Throws MachineError
// where the work on one mesh, or the meshes in memory, would take more memory than there is.
EditedMeshes edit_meshes(Scene& scene, const MeshEdits& edits, const MeshResources& resources = {});

}  // namespace vitrail
