// SPDX-License-Identifier: Apache-2.0
// A Wave is paths from the camera that are traced together, stage by stage. All begin, all look for their
// next hit, then all are shaded, then their shadow rays are traced, until none is left. Nothing of the
// picture depends on which paths these are.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tracer/transport/find_hit.h"
#include "tracer/transport/generate.h"
#include "tracer/transport/scatterer.h"
#include "tracer/transport/shadow_ray.h"
#include "tracer/transport/waves/lane_lists.h"

namespace vitrail {

class Wave {
 public:
  // States of paths and the data that are read for them fit into a core's second cache.
  static constexpr std::size_t most = 512;
  static_assert(most <= ShadowRays::most);

  Wave() : paths_(std::make_unique<CameraPath[]>(most)), at_(most) {}

  bool is_full() const { return next_ == most; }
  // Takes in a sample of the pixel (x, y) of the whole film. It must not be full.
  void add(const Tracing& tracing, int x, int y, std::uint32_t sample);
  // Returns a place, as new, for a path that has begun; it goes on where `resume` says so. The wave must not
  // be full.
  CameraPath& place() { return *std::construct_at(&paths_[next_++]); }
  // Goes on with the path in the place that was given last. `at` is set for a path that comes from elsewhere.
  void resume(const std::optional<Arrival>& at) {
    at_[next_ - 1] = at;
    live_.push_back(static_cast<std::uint32_t>(next_ - 1));
  }
  // They are the shadow rays of paths that begin in it.
  ShadowRays& shadows() { return shadows_; }

  // Traces all of them to their ends, or until they go on elsewhere. The wave is then empty.
  void trace(Tracing& tracing);

 private:
  void generate(Tracing& tracing, bool in_lanes);
  Given begin_in_lanes(const Tracing& tracing);
  void find_hits(Tracing& tracing);
  void find_in_one(Tracing& tracing);
  void shade_all(Tracing& tracing, bool in_lanes);

  std::unique_ptr<CameraPath[]> paths_;
  std::vector<std::optional<Arrival>> at_;
  std::vector<std::uint32_t> new_, live_;  // places of those that are to begin, that go on
  LaneLists lists_{most};
  ShadowRays shadows_;
  std::size_t next_ = 0;
};

}  // namespace vitrail
