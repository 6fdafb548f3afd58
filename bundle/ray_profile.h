// SPDX-License-Identifier: Apache-2.0
// A RayProfile says where the rays of a render went and what that took. `render --profile` writes it.
// `partition --profile`, which cuts the same scene anew, and `plan` read it.
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
    double seconds = 0;       // that they took, where rays go from domain to domain
    bool operator==(const Domain&) const = default;
  };

  // A Way counts rays that were traced in `from`, or left the camera, and went on to `to`, or sent others to
  // it.
  struct Way {
    static constexpr std::uint32_t camera = 0xffffffff;
    std::uint32_t from = camera, to = 0;
    std::uint64_t rays = 0;
    bool operator==(const Way&) const = default;
  };
  // Seconds are summed over threads and ranks.
  struct Cost {
    std::uint64_t camera_rays = 0;
    double trace_s = 0;   // all of tracing with every domain at hand: of the processor
    double camera_s = 0;  // until rays were in their first domain, beside the domains' seconds
    double load_s = 0;
    std::uint64_t loads = 0;  // of domains
    bool operator==(const Cost&) const = default;
  };

  Vector3d offset;  // world = the profile's coordinates + offset
  std::vector<KdNode> kd_nodes;
  std::vector<Domain> domains;
  std::vector<Way> ways;  // ascending by from, to
  Cost cost;

  RayProfile() = default;
  // `rays` and `seconds` are by domain.
  RayProfile(const Manifest& manifest, const std::vector<std::uint64_t>& rays,
             const std::vector<double>& seconds, std::vector<Way> ways, Cost cost);

  // Throws Error where the profile is of a bundle with other domains.
  void require_of(const Manifest& manifest) const;

  // Returns the domain that a point of the world lies in.
  std::uint32_t domain_at(Point3d world) const;
};

// Writes the profile as JSON. Throws MachineError.
void write_ray_profile(const std::filesystem::path& file, const RayProfile& profile);
// Throws Error for what is not a profile.
RayProfile read_ray_profile(const std::filesystem::path& file);

}  // namespace vitrail
