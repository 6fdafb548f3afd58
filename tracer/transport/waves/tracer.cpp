// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/waves/tracer.h"

#include "tracer/transport/connection.h"
#include "tracer/transport/gathering.h"
#include "tracer/transport/generate.h"
#include "tracer/transport/photons.h"
#include "tracer/transport/sensors.h"
#include "tracer/transport/shadow_ray.h"

namespace vitrail {

// Where the ways of rays are recorded, each is traced by itself: the recorder is told of one ray at a time.
void Tracer::make_room() {
  if (wave_.is_full() || tracing_.traffic) finish();
}

void Tracer::trace_camera(int x, int y, std::uint32_t sample) {
  make_room();
  wave_.add(tracing_, x, y, sample);
}

void Tracer::trace_photon(std::uint32_t number) { vitrail::trace_photon(tracing_, number); }

void Tracer::resume(const RayRecord& record, std::uint32_t domain) {
  const Arrival at{domain, record.head.is(ray_resolved)};
  switch (record.head.kind()) {
    case RayRecordKind::path:
      make_room();
      if (tracing_.traffic) tracing_.traffic->begin({domain, true});
      unpack(tracing_, record.path, wave_.place());
      wave_.resume(at);
      break;
    case RayRecordKind::connection:
      vitrail::resume(tracing_, record.connection, at);
      break;
    case RayRecordKind::photon:
      vitrail::resume(tracing_, record.photon, at);
      break;
    case RayRecordKind::probe: {
      make_room();
      if (tracing_.traffic) tracing_.traffic->begin({domain, true});
      const Begun begun = vitrail::resume(tracing_, record.probe, at, wave_.place(), wave_.shadows());
      if (begun == Begun::goes_on) wave_.resume(std::nullopt);
      if (begun == Begun::ends) ++tracing_.counters.died;
      break;
    }
  }
}

void Tracer::resume(const ShadowRecord& record, std::uint32_t domain) {
  vitrail::resume(tracing_, record, domain);
}

void Tracer::answer(const Gather& question) { vitrail::answer(tracing_, question); }

}  // namespace vitrail
