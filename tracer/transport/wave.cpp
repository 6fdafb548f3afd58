// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/wave.h"

#include "tracer/transport/generate.h"
#include "tracer/transport/shading.h"

namespace vitrail {

void Wave::trace(Tracing& tracing) {
  vitrail::trace(tracing, shadows_);
  const bool in_lanes = LaneLists::apply_to(tracing);
  if (in_lanes) lists_.begin(tracing);
  while (!live_.empty()) {
    find_hits(tracing);
    shade_all(tracing, in_lanes);
    vitrail::trace(tracing, shadows_);
  }
  next_ = 0;
}

void Wave::find_hits(Tracing& tracing) {
  std::size_t kept = 0;
  for (const std::uint32_t i : live_) {
    CameraPath& path = paths_[i];
    const auto elsewhere = find_hit(tracing, path, at_[i]);
    at_[i].reset();
    if (elsewhere)
      send(tracing, path, *elsewhere);
    else
      live_[kept++] = i;
  }
  live_.resize(kept);
}

void Wave::shade_all(Tracing& tracing, bool in_lanes) {
  std::size_t kept = 0, alone = 0;
  for (const std::uint32_t i : live_) {
    if (in_lanes && lists_.take(tracing, paths_[i], i)) continue;
    ++alone;
    if (shade(tracing, paths_[i], shadows_)) live_[kept++] = i;
  }
  tracing.counters.died += alone - kept;
  tracing.counters.rays_indirect += kept;
  live_.resize(kept);
  if (in_lanes) lists_.run(tracing, paths_.get(), shadows_, live_);
}

}  // namespace vitrail
