// SPDX-License-Identifier: Apache-2.0
// Paths from the camera that are traced together, stage by stage: all look for their next hit, then all are
// shaded, then their shadow rays are traced, until none is left. Nothing of the picture depends on which
// paths these are.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tracer/transport/find_hit.h"
#include "tracer/transport/lane_lists.h"
#include "tracer/transport/scatterer.h"
#include "tracer/transport/shadow_ray.h"

namespace vitrail {

class Wave {
 public:
  // States of paths and what they are read for fit into a core's second cache.
  static constexpr std::size_t most = 512;

  Wave() : paths_(std::make_unique<CameraPath[]>(most)), at_(most) { live_.reserve(most); }

  std::size_t size() const { return live_.size(); }
  // A place for one more, whose path is as new; `size` < most.
  CameraPath& place() { return paths_[next_] = {}; }
  // Takes in the path that has been made in that place. `at`: of one that comes from elsewhere.
  void take(const std::optional<Arrival>& at) {
    at_[next_] = at;
    live_.push_back(next_++);
  }
  // Of paths that begin in it.
  ShadowRays& shadows() { return shadows_; }

  // Traces all of them to their ends, or until they go on elsewhere. It is empty then.
  void trace(Tracing& tracing);

 private:
  void find_hits(Tracing& tracing);
  void shade_all(Tracing& tracing, bool in_lanes);

  std::unique_ptr<CameraPath[]> paths_;
  std::vector<std::optional<Arrival>> at_;
  std::vector<std::uint32_t> live_;  // places of those that go on
  LaneLists lists_{most};
  ShadowRays shadows_;
  std::uint32_t next_ = 0;
};

}  // namespace vitrail
