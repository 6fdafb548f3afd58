// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/sensors.h"

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/transport/connect.h"
#include "tracer/transport/gathering.h"
#include "tracer/transport/generate.h"

namespace vitrail {

namespace {

// What of the place of a sensor is known.
enum class SensorPlace : std::uint8_t {
  nothing,
  medium,      // dielectrics are yet to be counted
  dielectrics  // it is open to outside of everything, where the ray now goes from the camera
};

// A ray that looks for it. Its throughput is that of the path that is to begin.
struct Probe : Traveller {
  FilmSample film;
  SensorPlace known = SensorPlace::nothing;
};

Probe probe_of(const CameraPath& path) {
  Probe probe;
  static_cast<Traveller&>(probe) = path;
  probe.film = path.film;
  return probe;
}

void seek(Probe& probe, Point3d from, Vector3d direction) {
  depart(probe, {from, cast<float>(from), no_triangle, probe.inside}, direction);
}

Sensor sensor_of(const Tracing& tracing, const Probe& probe) {
  return *tracing.scene.camera.sensor(column_of(tracing, probe.film));
}

// At what it meets: whether it looks on.
bool seek_on(const Tracing& tracing, Probe& probe) {
  const Interiors& interiors = tracing.scene.interiors;
  if (probe.meets_surface()) {
    const Interaction at = interaction_at(tracing, probe, narrow_cone(tracing, probe.film.sample));
    const Surface& surface = surface_at(tracing, probe);
    Interiors::Told told{probe.inside, probe.known == SensorPlace::medium};
    if (opacity_at(tracing, surface, at) > 0) {
      if (probe.known != SensorPlace::dielectrics)
        told = interiors.told_by(told, surface, at.front);
      else if (!interiors.has_priority(surface))
        told.state = interiors.beside(told.state, surface, !at.front, true);
    }
    probe.inside = told.state;
    if (told.medium) probe.known = SensorPlace::medium;
    if (interiors.tells_all(told)) return false;
    continue_straight(tracing, probe, at, nullptr);
    return true;
  }
  if (probe.known != SensorPlace::nothing) return false;
  probe.known = SensorPlace::dielectrics;
  probe.inside =
      static_cast<std::uint8_t>(probe.inside + interiors.state_in(tracing.manifest().camera_medium));
  if (!tracing.scene.replaced_camera) return false;
  seek(probe, *tracing.scene.replaced_camera, sensor_of(tracing, probe).normal);
  return true;
}

// A path's first event. False along the sensor's plane, where the path ends.
bool leave_sensor(Tracing& tracing, CameraPath& path, const Sensor& sensor, ShadowRays& shadows) {
  find_wavelengths(tracing, path, path.film);
  const Departure from{sensor.position, cast<float>(sensor.position), no_triangle, path.inside};
  const std::uint32_t candidates = light_candidates(tracing, path, from.p, true);
  if (tracing.scene.lights.can_sample() && !tracing.scene.daylight.reflected_alone)
    connect_sensor(tracing, path, from, sensor.normal, candidates, shadows);
  if (tracing.photons) gather_at_sensor(tracing, path, sensor);
  const std::array<float, 4> u = numbers_for_scattering(path);
  const Point2d disk = concentric_disk({static_cast<double>(u[0]), static_cast<double>(u[1])});
  const double cosine = safe_sqrt(1 - disk.x * disk.x - disk.y * disk.y);
  const Vector3d n = sensor.normal;
  const Vector3d x = normalize(cross(std::abs(n.x) < 0.5 ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0}, n));
  path.pdf = density_beside(cosine / pi, candidates);
  path.connected = true;
  ++path.depth;
  path.only_straight = tracing.settings().direct_only || tracing.photons;
  depart(path, from, x * disk.x + cross(n, x) * disk.y + n * cosine);
  return path.pdf > 0;
}

void pack(const Tracing&, const Probe& probe, bool resolved, RayRecord& record) {
  ProbeRecord& r = record.probe;
  static_cast<RayRecordHead&>(r) = head_of(probe, RayRecordKind::probe, resolved);
  r.sample = SampleRecord::of(probe.film.pixel, probe.film.sample, 0);
  r.known = static_cast<std::uint8_t>(probe.known);
}

Begun follow(Tracing& tracing, Probe& probe, std::optional<Arrival> at, CameraPath& path,
             ShadowRays& shadows) {
  for (;; at.reset()) {
    if (const auto elsewhere = find_hit(tracing, probe, at)) {
      send(tracing, probe, *elsewhere);
      return Begun::elsewhere;
    }
    if (!seek_on(tracing, probe)) break;
    ++tracing.counters.rays_indirect;
  }
  static_cast<Traveller&>(path) = probe;
  path.film = probe.film;
  path.unrecorded = tracing.film.layers().any();
  if (!leave_sensor(tracing, path, sensor_of(tracing, probe), shadows)) return Begun::ends;
  ++tracing.counters.rays_indirect;
  return Begun::goes_on;
}

}  // namespace

Begun begin_at(Tracing& tracing, CameraPath& path, const Sensor& sensor, ShadowRays& shadows) {
  const Interiors& interiors = tracing.scene.interiors;
  if (!interiors.divide_space())
    return leave_sensor(tracing, path, sensor, shadows) ? Begun::goes_on : Begun::ends;
  Probe probe = probe_of(path);
  probe.inside = interiors.state_in(-1);
  seek(probe, sensor.position, sensor.normal);
  return follow(tracing, probe, std::nullopt, path, shadows);
}

Begun resume(Tracing& tracing, const ProbeRecord& record, const Arrival& at, CameraPath& path,
             ShadowRays& shadows) {
  Probe probe;
  probe.film.pixel = record.sample.pixel;
  probe.film.sample = record.sample.sample();
  begin(tracing, probe, probe.film);
  unpack_head(record, probe);
  probe.known = static_cast<SensorPlace>(record.known);
  return follow(tracing, probe, at, path, shadows);
}

}  // namespace vitrail
