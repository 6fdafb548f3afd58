// SPDX-License-Identifier: Apache-2.0
// This file visits all triangles of a scene, one block after the other.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "partitioner/placing/world.h"

namespace vitrail {

// A Block has triangles [begin, end) of a placement's mesh.
struct Block {
  const Placement& placement;
  const MeshPlacer& placer;
  std::size_t begin, end;
};
inline constexpr std::size_t block_triangles = 8192;  // that begin at multiples of it

// Calls `visit` with every block once, from many threads. Deferred meshes are loaded, about as many at once
// as take `load_bytes`, and let go of again.
void place_scene(const World& world, std::uint64_t load_bytes,
                 const std::function<void(const Block&)>& visit);

// Counts the triangles that may emit, whether an instance has them or not.
std::uint64_t emissive_triangles_of(const World& world);

// Emissive has the triangles that emit, and what else a manifest has of them.
struct Emissive {
  std::vector<EmissiveQuadric> quadrics;
  std::vector<EmissiveTriangle> triangles;
  std::vector<CornerValues> attributes;   // [triangle][slot]
  std::vector<FloatParameter> opacities;  // [triangle]
};

// A SceneTally is what the placed triangles say of the scene, in whatever order they come.
class SceneTally {
 public:
  explicit SceneTally(const World& world);

  // Adds the block's triangles, which are at `placed` from `at` on. From any thread.
  void add(const Block& block, const PlacedTriangles& placed, std::uint64_t at);
  // Sets bounds, scale, emissive_triangles and what is theirs, and scene_hash, once objects are written.
  void finish(Manifest& manifest);
  // Returns the hashes of all blocks, in the order of placements.
  const std::vector<std::uint64_t>& block_hashes() const { return hashes_; }

 private:
  void make_room_for_emissive();
  void add_shining(const ShiningPlacement& shining, std::size_t first_emissive);

  const World& world_;
  std::vector<std::size_t> first_block_;  // of each placement
  std::vector<std::uint64_t> hashes_;     // of each block
  std::vector<std::uint32_t> surfaces_;   // of each placement
  std::mutex mutex_;
  Bounds3f bounds_;
  // It has a place for each triangle that may emit, by their ids. The first one of each placement, and of
  // each that shines in objects, is below.
  Emissive emissive_;
  std::vector<std::size_t> first_emissive_, first_shining_;
  bool emissive_attributes_ = false, emissive_opacities_ = false;  // whether there are any
};

// Returns Manifest::scene_hash, from the hashes of the blocks. The manifest has all but
// the kd-tree and the domains.
std::uint64_t scene_hash_of(const World& world, const Manifest& manifest,
                            std::span<const std::uint64_t> block_hashes);

}  // namespace vitrail
