// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/flatten.h"

#include "partitioner/placing/place_scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

FlatScene flatten(World world, std::uint64_t load_bytes, const std::function<void(std::uint64_t)>& placed) {
  FlatScene flat;
  static_cast<PlacedTriangles&>(flat) = make_room(world.rule(), world.own_triangles);
  flat.ids.reserve(world.own_triangles);
  std::vector<std::uint64_t> first;  // of each placement, in `flat`
  for (const Placement& p : world.placements) {
    first.push_back(flat.ids.size());
    for (std::uint64_t i = 0; i < triangles_of(*p.mesh); ++i)
      flat.ids.push_back(static_cast<std::uint32_t>(p.first_triangle + i));
  }
  SceneTally tally(world);
  place_scene(world, load_bytes, [&](const Block& block) {
    const auto placement = static_cast<std::size_t>(&block.placement - world.placements.data());
    const std::uint64_t at = first[placement] + block.begin;
    block.placer.place(block.begin, block.end, flat, at);
    tally.add(block, flat, at);
    if (placed) placed(block.end - block.begin);
  });
  tally.finish(world.manifest);
  flat.manifest = std::move(world.manifest);
  flat.block_hashes = tally.block_hashes();
  return flat;
}

FlatScene flatten(const Scene& scene, const std::filesystem::path& bundle, const WorldOptions& options) {
  return flatten(world_of(scene, bundle, options), std::uint64_t{1} << 30);
}

}  // namespace vitrail
