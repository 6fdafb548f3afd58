// SPDX-License-Identifier: Apache-2.0
// A scene that does not fit into memory is spilled to buckets on disk.
#pragma once

#include "partitioner/cutting/kd_plan.h"
#include "partitioner/placing/place_scene.h"
#include "partitioner/spilling/spill.h"
#include "partitioner/writing/write_objects.h"

namespace vitrail {

// Returns the bounds of triangles chosen at random, at most about so many, in the bundle's coordinates.
inline constexpr std::uint64_t most_samples = 1u << 18;
std::vector<Bounds3f> sample_of(const World& world, const SceneInstances& instances,
                                std::uint64_t most = most_samples);

// Sends all triangles down the tree to the bucket of its leaf. `placed` gets how many, from any thread.
void spill_scene(const World& world, const KdPlan& plan, std::uint64_t load_bytes, BucketSpill& spill,
                 SceneTally& tally, const std::function<void(std::uint64_t)>& placed);

}  // namespace vitrail
