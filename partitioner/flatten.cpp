// SPDX-License-Identifier: Apache-2.0
#include "partitioner/flatten.h"

#include <numeric>

#include "partitioner/place_scene.h"

namespace vitrail {

FlatScene flatten(World world, std::uint64_t load_bytes, const std::function<void(std::uint64_t)>& placed) {
  FlatScene flat;
  const std::uint64_t triangles = world.manifest.triangles;
  static_cast<PlacedTriangles&>(flat) = make_room(world.rule(), triangles);
  flat.ids.resize(triangles);
  std::iota(flat.ids.begin(), flat.ids.end(), 0u);
  SceneTally tally(world);
  place_scene(world, load_bytes, [&](const Block& block) {
    const std::uint64_t at = block.placement.first_triangle + block.begin;
    block.placer.place(block.begin, block.end, flat, at);
    tally.add(block, flat, at);
    if (placed) placed(block.end - block.begin);
  });
  tally.finish(world.manifest);
  flat.manifest = std::move(world.manifest);
  return flat;
}

FlatScene flatten(const Scene& scene, const std::filesystem::path& bundle, bool everything) {
  return flatten(world_of(scene, bundle, everything), std::uint64_t{1} << 30);
}

}  // namespace vitrail
