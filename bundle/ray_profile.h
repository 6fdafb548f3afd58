// SPDX-License-Identifier: Apache-2.0
// Where the rays of a render went: how many were traced in each domain. Written by `render --profile`, read
// by `partition --profile`, which cuts the same scene anew.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

struct RayProfile {
  struct Domain {
    std::uint64_t rays = 0;   // that were traced in it
    std::uint64_t items = 0;  // triangles, pieces and instances
    bool operator==(const Domain&) const = default;
  };

  Vector3d offset;  // world = the profile's coordinates + offset
  std::vector<KdNode> kd_nodes;
  std::vector<Domain> domains;

  RayProfile() = default;
  RayProfile(const Manifest& manifest, const std::vector<std::uint64_t>& rays);

  // The domain that a point of the world lies in.
  std::uint32_t domain_at(Point3d world) const;
};

// JSON. Throws MachineError.
void write_ray_profile(const std::filesystem::path& file, const RayProfile& profile);
// Throws Error for what is not a profile.
RayProfile read_ray_profile(const std::filesystem::path& file);

}  // namespace vitrail
