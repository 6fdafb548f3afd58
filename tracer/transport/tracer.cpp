// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/tracer.h"

#include "tracer/transport/connection.h"
#include "tracer/transport/gathering.h"
#include "tracer/transport/generate.h"
#include "tracer/transport/photons.h"
#include "tracer/transport/sensors.h"
#include "tracer/transport/shadow_ray.h"

namespace vitrail {

// Where the ways of rays are recorded, each is traced by itself: the recorder is told of one ray at a time.
void Tracer::take(const std::optional<Arrival>& at) {
  wave_.take(at);
  if (wave_.size() == Wave::most || tracing_.traffic) finish();
}

void Tracer::trace_camera(int x, int y, std::uint32_t sample) {
  CameraPath& path = wave_.place();
  if (!begin(tracing_, path, x, y, sample)) return;
  if (tracing_.traffic) tracing_.traffic->begin({});
  ++tracing_.counters.born;
  if (const auto sensor = tracing_.scene.camera.sensor(x)) {
    const Begun begun = begin_at(tracing_, path, *sensor, wave_.shadows());
    if (!goes_on(begun)) return;
  }
  take(std::nullopt);
}

bool Tracer::goes_on(Begun begun) {
  if (begun == Begun::goes_on) return true;
  if (begun == Begun::ends) ++tracing_.counters.died;
  trace(tracing_, wave_.shadows());  // its place is the next one's
  return false;
}

void Tracer::trace_photon(std::uint32_t number) { vitrail::trace_photon(tracing_, number); }

void Tracer::resume(const RayRecord& record, std::uint32_t domain) {
  const Arrival at{domain, record.head.is(ray_resolved)};
  switch (record.head.kind()) {
    case RayRecordKind::path: {
      unpack(tracing_, record.path, wave_.place());
      if (tracing_.traffic) tracing_.traffic->begin({domain, true});
      take(at);
      break;
    }
    case RayRecordKind::connection:
      vitrail::resume(tracing_, record.connection, at);
      break;
    case RayRecordKind::photon:
      vitrail::resume(tracing_, record.photon, at);
      break;
    case RayRecordKind::probe: {
      if (tracing_.traffic) tracing_.traffic->begin({domain, true});
      if (goes_on(vitrail::resume(tracing_, record.probe, at, wave_.place(), wave_.shadows())))
        take(std::nullopt);
      break;
    }
  }
}

void Tracer::resume(const ShadowRecord& record, std::uint32_t domain) {
  vitrail::resume(tracing_, record, domain);
}

void Tracer::answer(const Gather& question) { vitrail::answer(tracing_, question); }

}  // namespace vitrail
