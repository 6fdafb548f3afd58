// SPDX-License-Identifier: Apache-2.0
// Spectral light transport through whatever sub-domains are resident: paths from the camera, photons from
// lights. A ray that needs an absent domain is put into the outbox; nothing about the picture depends on
// which ones were absent.
#pragma once

#include "tracer/transport/tracing.h"
#include "tracer/transport/waves/wave.h"

namespace vitrail {

// One a thread. What it is given begins or goes on; camera paths may wait in `wave` until `finish`.
class Tracer {
 public:
  Tracer(const Tracing& tracing, Wave& wave) : tracing_(tracing), wave_(wave) {}
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  // Sample `sample` of the pixel (x, y) of the whole film, which lies in the crop.
  void trace_camera(int x, int y, std::uint32_t sample);
  // While photons fly: that one of the iteration's.
  void trace_photon(std::uint32_t number);
  // Goes on with a ray in `domain`, which is resident.
  void resume(const RayRecord& record, std::uint32_t domain);
  void resume(const ShadowRecord& record, std::uint32_t domain);
  // What the map has for a path that ended elsewhere.
  void answer(const Gather& question);
  // Traces all that waits.
  void finish() { wave_.trace(tracing_); }

 private:
  void make_room();

  Tracing tracing_;
  Wave& wave_;
};

}  // namespace vitrail
