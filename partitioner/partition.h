// SPDX-License-Identifier: Apache-2.0
// Partitioning makes a bundle of a scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "bundle/kept_glazing.h"
#include "bundle/ray_profile.h"
#include "partitioner/memory_ledger.h"
#include "scene/records/scene.h"

namespace vitrail {

// PartitionOptions say how a scene is divided.
struct PartitionOptions {
  std::uint32_t domains = 0;          // number of leaves; 0: chosen by domain_bytes
  std::uint64_t domain_bytes = 0;     // target size of a domain file; 0 with domains = 0: 64 MiB
  std::uint64_t memory_bytes = 0;     // most resident memory; 0: three quarters of the machine's
  double memory_share = 1;            // of what the plan would take for the parts of a scene
  std::uint32_t domains_at_once = 0;  // as if no more fitted into memory, for tests; 0: as many as fit
  std::uint64_t pack_bytes = 0;       // most of a pack of domains (bundle/packs.h); 0: a file a domain
  int threads = 0;                    // 0: one a processor allowed
  bool flatten = false;               // copies instead of instances
  std::optional<RayProfile> profile;  // of an earlier render of the scene
  std::vector<KeptGlazing> glazings;  // that render can set, by materials of the scene
  bool durable = false;               // on the disk before it returns, also after a power failure
  bool median = false;                // cuts in the middle, for comparison
  std::filesystem::path cache;        // of baked images (FileCache); empty: none
  std::filesystem::path bundles;      // of domains and objects (BundleCache); empty: none
  bool everything = false;            // as if the scene required all that there is, for measuring
};

// PartitionStats is the statistics contract of `partition --stats`.
struct PartitionStats {
  std::uint64_t input_triangles = 0, cut_triangles = 0, pieces = 0, domains = 0;
  std::uint64_t quadrics = 0;         // shapes that are no triangles, wherever they stand
  std::uint64_t domains_planned = 0;  // more than there are where cutting stopped: it only made pieces
  std::uint64_t triangles_min = 0, triangles_max = 0;
  double triangles_mean = 0;
  std::uint64_t bundle_bytes = 0, duplicates = 0;
  double area_error = 0;
  std::uint64_t objects = 0, instances = 0;  // files of objects; references to them in all domains
  std::uint64_t domain_bytes_max = 0;        // that tracing one takes, with the objects it needs
  double wall_s = 0, cpu_s = 0;
  std::uint64_t peak_rss_bytes = 0, memory_budget_bytes = 0;
  MemoryLedger ledger;            // of the scene's records
  std::uint64_t buckets = 1;      // parts of the scene that were in memory one after the other
  std::uint64_t spill_bytes = 0;  // written to disk on the way to them
  double triangles_per_s = 0;     // of the input
  // They count shapes and instances so far from the bundle's origin that rounding moves their vertices by
  // more than a thousandth of their size.
  std::uint64_t coarse_shapes = 0;
};

// Returns the bytes of meshes that an importer should keep (MeshMemory) for a budget of so many bytes.
std::uint64_t mesh_bytes_within(std::uint64_t memory_bytes);

// Writes the bundle directory `out` (built beside it under a temporary name, renamed when whole; an existing
// bundle of that name is replaced). A scene that does not fit into the memory is divided into buckets first,
// which are written to disk and divided one after the other. `progress` gets the done fraction in [0,1] and
// the name of the stage, from any thread but one at a time; an exception from it stops the work. The domains,
// their order and every byte depend on the scene and the options, never on the threads. Throws Error for bad
// input, UsageError, and MachineError, for too little memory too.
PartitionStats partition(const Scene& scene, const std::filesystem::path& out,
                         const PartitionOptions& options,
                         const std::function<void(double, const char*)>& progress = {});

}  // namespace vitrail
