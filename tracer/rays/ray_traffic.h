// SPDX-License-Identifier: Apache-2.0
// It records which domains rays were traced in, from where they came and how long that took, for render
// --profile. Each thread has one.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "bundle/ray_profile.h"

namespace vitrail {

class RayTraffic {
 public:
  explicit RayTraffic(std::size_t domains) : visits_(domains), seconds_(domains + 1) {}

  // It says where the ray at hand is: in a domain, at the camera, or about to be traced where it was sent to.
  // The sender has counted the way of a ray that `arrives`.
  struct Place {
    std::uint32_t domain = RayProfile::Way::camera;
    bool arrives = false;
  };
  Place place() const { return place_; }
  void set(Place place) {
    look_at_clock();
    place_ = place;
  }
  // Begins a ray; the next ray or `end` follows. Reading the clock takes time itself, so only a few rays are
  // timed.
  void begin(Place place) {
    end();
    place_ = place;
    constexpr unsigned of = 13;
    timed_ = ++rays_ % of == 0;
    if (timed_) since_ = Clock::now();
  }
  void end() {
    look_at_clock();
    timed_ = false;
  }

  void visit(std::uint32_t domain) {
    if (!place_.arrives) leave_for(domain);
    set({domain});
    ++visits_[domain];
  }
  void leave_for(std::uint32_t domain) { ++ways_[std::uint64_t{place_.domain} << 32 | domain]; }

  void add(const RayTraffic& other) {
    for (std::size_t d = 0; d < visits_.size(); ++d) visits_[d] += other.visits_[d];
    for (std::size_t d = 0; d < seconds_.size(); ++d) seconds_[d] += other.seconds_[d];
    for (const auto& [way, rays] : other.ways_) ways_[way] += rays;
  }
  const std::vector<std::uint64_t>& visits() const { return visits_; }
  // They are of the rays that were timed: by domain, and last the time before a ray's first domain.
  const std::vector<double>& seconds() const { return seconds_; }
  // They are by the domain that rays come from, in the upper half, and the one that they go to, in the lower.
  const std::unordered_map<std::uint64_t, std::uint64_t>& ways() const { return ways_; }

 private:
  using Clock = std::chrono::steady_clock;

  void look_at_clock() {
    if (!timed_) return;
    const auto now = Clock::now();
    // No ray takes that long in a domain: another thread had the core.
    constexpr double longest_s = 1e-3;
    const double passed = std::chrono::duration<double>(now - since_).count();
    if (passed < longest_s) seconds_[std::min<std::size_t>(place_.domain, visits_.size())] += passed;
    since_ = now;
  }

  std::vector<std::uint64_t> visits_;  // rays, by domain
  std::vector<double> seconds_;
  std::unordered_map<std::uint64_t, std::uint64_t> ways_;
  Place place_;
  bool timed_ = false;
  unsigned rays_ = 0;
  Clock::time_point since_;
};

}  // namespace vitrail
