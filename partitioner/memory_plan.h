// SPDX-License-Identifier: Apache-2.0
// A PartitionMemory is how a scene is partitioned within a budget of memory.
#pragma once

#include <cstdint>

#include "bundle/manifest.h"

namespace vitrail {

struct PartitionMemory {
  std::uint32_t domains = 1;
  std::uint32_t domains_at_once = 1;  // in memory with all their triangles: a bucket
  std::uint32_t domains_in_work = 1;  // of which trees are being built
  std::uint64_t load_bytes = 0;       // for meshes that are loaded from their files
  std::uint64_t spill_bytes = 0;      // for what is on its way to the buckets
  std::uint64_t kept_bytes = 0;       // freed blocks up to this size stay: page faults are dear
};

struct MemoryNeeds {
  std::uint64_t budget_bytes = 0;
  std::uint64_t triangles = 0;       // that no instance has
  double expansion = 1;              // of them: triangles and pieces in all domains over triangles
  std::uint64_t instance_bytes = 0;  // of references to objects, in memory and in the domains
  std::uint64_t quadrics = 0;        // that references are made to as they are needed
  std::uint64_t scene_bytes = 0;     // of the budget, already in use, but for meshes
  std::uint64_t mesh_bytes = 0;      // of all meshes, of which as many are in memory as meshes_within says
  std::uint64_t held_meshes = 0;     // of those that are there in any case
  std::uint64_t largest_mesh = 0;    // bytes of one that is in its file
  double object_bytes = 0;           // while the largest object that has instances is written
  std::uint64_t baking_bytes = 0;    // while images are baked
  std::uint32_t domains = 0;         // 0: by domain_bytes
  std::uint64_t domain_bytes = 0;  // of a file; 0: 64 MiB, or less where that is more than 1/32 of the budget
  bool image_library = false;      // loaded
  double share = 1;                // of what is left, for the parts of the scene
  int threads = 1;
};

// Returns the bytes of one in a file, with its share of the tree: measured, docs/why/partitioning.md.
double bytes_of_a_triangle(const Manifest& manifest);

// Returns what the budget leaves for triangles; less than 0 where it leaves nothing.
double bytes_left(const MemoryNeeds& needs);
// Returns what `triangles` in memory take while an object's file of `built` of them is made.
double bytes_to_build(const Manifest& manifest, double triangles, double built);

// Returns the bytes of meshes that stay in memory within a budget; other meshes stay in their files.
std::uint64_t meshes_within(std::uint64_t budget_bytes);

// Returns the least budget from needs.budget_bytes on that is enough for all of it, to a MiB.
std::uint64_t least_budget(const Manifest& manifest, MemoryNeeds needs);

// Returns a budget, not less than `budget_bytes`, in which so much is held beside the program.
std::uint64_t budget_to_hold(std::uint64_t bytes, std::uint64_t budget_bytes);

// Throws UsageError for too many.
std::uint32_t number_of_domains(const Manifest& manifest, const MemoryNeeds& needs);

// Throws MemoryNeeded where not even one domain or one mesh fits, UsageError for too many domains.
PartitionMemory plan_memory(const Manifest& manifest, const MemoryNeeds& needs);

}  // namespace vitrail
