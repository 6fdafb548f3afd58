// SPDX-License-Identifier: Apache-2.0
// A Tracer does spectral light transport through whatever sub-domains are resident: paths from the camera,
// photons from lights. A ray that needs an absent domain is put into the outbox; nothing about the picture
// depends on which ones were absent.
#pragma once

#include "tracer/transport/tracing.h"
#include "tracer/transport/waves/wave.h"

namespace vitrail {

// Each thread has one. What it is given begins or goes on; camera paths may wait in `wave` until `finish`.
class Tracer {
 public:
  Tracer(const Tracing& tracing, Wave& wave) : tracing_(tracing), wave_(wave) {}
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  // Traces sample `sample` of the pixel (x, y) of the whole film, which lies in the crop.
  void trace_camera(int x, int y, std::uint32_t sample);
  // Traces the iteration's photon of that number, while photons fly.
  void trace_photon(std::uint32_t number);
  // Goes on with a ray in `domain`, which is resident.
  void resume(const RayRecord& record, std::uint32_t domain);
  void resume(const ShadowRecord& record, std::uint32_t domain);
  // Answers a question of a path that ended elsewhere from the map.
  void answer(const Gather& question);
  // Traces all that waits.
  void finish() { wave_.trace(tracing_); }

 private:
  void make_room();

  Tracing tracing_;
  Wave& wave_;
};

}  // namespace vitrail
