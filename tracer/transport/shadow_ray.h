// SPDX-License-Identifier: Apache-2.0
// Rays to a point on a light, which nothing lets through in part: whether anything is in their way. Where
// something does, connections (connection.h) wait beside them.
#pragma once

#include <memory>

#include "tracer/transport/connection.h"

namespace vitrail {

// Its values are rounded as those of its record.
struct ShadowRay {
  Ray ray;
  DirectionCode direction;  // the ray's
  float tmax = 0;
  SampledSpectrum radiance;
  std::uint32_t pixel = 0, sample = 0;
  std::uint8_t light_group = 0;           // as GroupedLights says
  double time_s = 0;                      // its path's
  const SensorWeights* sensor = nullptr;  // its path's, if that is at hand
};
// Those that wait to be traced together: not more than `most`, one of each path of a wave.
struct ShadowRays {
  static constexpr std::size_t most = 512;
  std::unique_ptr<ShadowRay[]> rays = std::make_unique<ShadowRay[]>(most);
  std::size_t count = 0;
  Connections connections;
};

// Deposits what gets through of rays and connections that begin here, and leaves none of them.
void trace(Tracing& tracing, ShadowRays& rays);
// Goes on with a ray in `domain`, which is resident.
void resume(Tracing& tracing, const ShadowRecord& record, std::uint32_t domain);

}  // namespace vitrail
