// SPDX-License-Identifier: Apache-2.0
// Which domains rays were traced in and from where they came: what render --profile records. One a thread.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "bundle/ray_profile.h"

namespace vitrail {

class RayTraffic {
 public:
  explicit RayTraffic(std::size_t domains) : visits_(domains) {}

  // Where the ray is that is being traced: in a domain, at the camera, or about to be traced where it was
  // sent to, a way that the sender has counted.
  struct Place {
    std::uint32_t domain = RayProfile::Way::camera;
    bool arrives = false;
  };
  Place place() const { return place_; }
  void set(Place place) { place_ = place; }

  void visit(std::uint32_t domain) {
    if (!place_.arrives) leave_for(domain);
    place_ = {domain};
    ++visits_[domain];
  }
  void leave_for(std::uint32_t domain) { ++ways_[std::uint64_t{place_.domain} << 32 | domain]; }

  void add(const RayTraffic& other) {
    for (std::size_t d = 0; d < visits_.size(); ++d) visits_[d] += other.visits_[d];
    for (const auto& [way, rays] : other.ways_) ways_[way] += rays;
  }
  const std::vector<std::uint64_t>& visits() const { return visits_; }
  // By the domain they come from in the upper half, that they go to in the lower.
  const std::unordered_map<std::uint64_t, std::uint64_t>& ways() const { return ways_; }

 private:
  std::vector<std::uint64_t> visits_;  // rays, by domain
  std::unordered_map<std::uint64_t, std::uint64_t> ways_;
  Place place_;
};

}  // namespace vitrail
