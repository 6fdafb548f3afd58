// SPDX-License-Identifier: Apache-2.0
// This file finds the budget that a scene needs, before it is placed.
#pragma once

#include "partitioner/memory_plan.h"
#include "partitioner/partition.h"
#include "partitioner/placing/world.h"

namespace vitrail {

// A reference to an object takes so much: in a domain file with its place in the tree, and
// in memory while domains are written.
inline constexpr std::uint64_t bytes_of_reference = 192;

// Returns the needs by the records of the scene, its meshes, and the options.
MemoryNeeds needs_of(const Scene& scene, const PartitionOptions& options);

// Returns the most bytes of an object in one file: a domain is to have room for it and its places.
std::uint64_t most_object_bytes(std::uint64_t domain_bytes);

// Returns the least budget, not less than options.memory_bytes, in which the scene is partitioned, with its
// images read. `more_bytes` are held besides its records. It counts the records and does not look at
// materials, so that (u,v) count where there are textures.
std::uint64_t least_memory(const Scene& scene, const PartitionOptions& options, std::uint64_t more_bytes = 0);

}  // namespace vitrail
