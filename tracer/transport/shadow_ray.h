// SPDX-License-Identifier: Apache-2.0
// A ShadowRay goes to a point on a light in a scene where nothing lets light through in part. It finds
// whether anything is in its way. In other scenes connections (connection.h) wait beside shadow rays.
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
// These rays wait to be traced together: not more than `most`, one of each path of a wave.
struct ShadowRays {
  static constexpr std::size_t most = 512;
  std::unique_ptr<ShadowRay[]> rays = std::make_unique<ShadowRay[]>(most);
  std::size_t count = 0;
  Connections connections;
};

// Deposits the light of rays and connections that begin here and get through, and leaves none of them.
void trace(Tracing& tracing, ShadowRays& rays);
// Goes on with a ray in `domain`, which is resident.
void resume(Tracing& tracing, const ShadowRecord& record, std::uint32_t domain);

}  // namespace vitrail
