// SPDX-License-Identifier: Apache-2.0
// Flattening makes of a scene one list of world triangles around the origin.
#pragma once

#include <filesystem>

#include "partitioner/cutting/cut.h"
#include "partitioner/placing/world.h"

namespace vitrail {

// A FlatScene has the triangles that no instance has.
struct FlatScene : NumberedTriangles {
  Manifest manifest;                        // all but the kd-tree, the domains and cut_triangles
  std::vector<std::uint64_t> block_hashes;  // SceneTally's
};

// See world_of and place_scene. `placed` gets the number of triangles placed, from any thread.
FlatScene flatten(World world, std::uint64_t load_bytes,
                  const std::function<void(std::uint64_t)>& placed = {});
FlatScene flatten(const Scene& scene, const std::filesystem::path& bundle, const WorldOptions& options = {});

}  // namespace vitrail
