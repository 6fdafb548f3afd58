// SPDX-License-Identifier: Apache-2.0
// Scene → bundle.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "bundle/manifest.h"
#include "scene/scene.h"

namespace vitrail {

struct PartitionOptions {
  std::uint32_t domains = 0;       // number of leaves; 0: chosen by domain_bytes
  std::uint64_t domain_bytes = 0;  // target size of a domain file; 0 with domains = 0: 64 MiB
  int threads = 0;                 // 0: all
  bool flatten = false;            // copies instead of instances
  bool everything = false;         // as if the scene required all that there is, for measuring
};

// The statistics contract of `partition --stats`.
struct PartitionStats {
  std::uint64_t input_triangles = 0, cut_triangles = 0, pieces = 0, domains = 0;
  std::uint64_t triangles_min = 0, triangles_max = 0;
  double triangles_mean = 0;
  std::uint64_t bundle_bytes = 0, duplicates = 0;
  double area_error = 0;
  std::uint64_t objects = 0, instances = 0;  // files of objects; references to them in all domains
  double wall_s = 0, cpu_s = 0;
  std::uint64_t peak_rss_bytes = 0;
};

// Writes the bundle directory `out` (built beside it under a temporary name, renamed when whole; an existing
// bundle of that name is replaced). `progress` is told the done fraction in [0,1] and what is going on. The
// domains, their order and every byte depend on the scene and the options, never on the threads.
PartitionStats partition(const Scene& scene, const std::filesystem::path& out,
                         const PartitionOptions& options,
                         const std::function<void(double, const char*)>& progress = {});

}  // namespace vitrail
