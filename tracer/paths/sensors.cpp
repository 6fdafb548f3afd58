// SPDX-License-Identifier: Apache-2.0
// Sensors: where paths begin that measure.
#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/paths/path_state.h"
#include "tracer/paths/path_tracer.h"

namespace vitrail {

namespace {

// What of the place of a sensor is known while a ray looks for it: a path's depth until the path begins.
enum Sought : std::uint32_t {
  nothing_known,
  medium_known,      // dielectrics are yet to be counted
  dielectrics_known  // it is open to outside of everything, where the ray now goes from the camera
};

}  // namespace

// False when the path ends here. The medium that the file gives is the camera's: where surfaces divide space,
// a sensor's own is found first, by a ray along its normal, which no surface hides that it lies in.
bool PathTracer::begin_at(Path& path, const Sensor& sensor) {
  if (!scene_.interiors.divide_space()) return leave_sensor(path, sensor);
  path.set(path_seeks);
  path.inside = scene_.interiors.state_in(-1);
  path.depth = nothing_known;
  seek(path, sensor.position, sensor.normal);
  return true;
}

void PathTracer::seek(Path& path, Point3d from, Vector3d direction) const {
  depart(path, {from, cast<float>(from), no_triangle, path.inside}, direction);
}

// At what such a ray meets.
bool PathTracer::seek_on(Path& path) {
  const auto width = static_cast<std::uint32_t>(film_.width());
  const Sensor sensor = *scene_.camera.sensor(film_.crop().x0 + static_cast<int>(path.pixel % width));
  const Interiors& interiors = scene_.interiors;
  if (path.met() == Met::surface) {
    const Interaction at = interaction_at(path);
    const Surface& surface = surface_at(path);
    Interiors::Told told{path.inside, path.depth == medium_known};
    if (opacity_at(surface, at) > 0) {
      if (path.depth != dielectrics_known)
        told = interiors.told_by(told, surface, at.front);
      else if (!interiors.has_priority(surface))
        told.state = interiors.beside(told.state, surface, !at.front, true);
    }
    path.inside = told.state;
    if (told.medium) path.depth = medium_known;
    if (!interiors.tells_all(told)) {
      continue_straight(path, at, nullptr);
      return true;
    }
  } else if (path.depth == nothing_known) {
    path.depth = dielectrics_known;
    path.inside = static_cast<std::uint8_t>(path.inside + interiors.state_in(manifest_.camera_medium));
    if (scene_.replaced_camera) {
      seek(path, *scene_.replaced_camera, sensor.normal);
      return true;
    }
  }
  path.clear(path_seeks);
  path.depth = 0;
  return leave_sensor(path, sensor);
}

// A sensor is a white diffuse surface at which paths begin: radiance leaves it, the irradiance over π. That
// is the path's first event. False along the sensor's plane, where the path ends.
bool PathTracer::leave_sensor(Path& path, const Sensor& sensor) {
  find_wavelengths(path);
  const Departure from{sensor.position, cast<float>(sensor.position), no_triangle, path.inside};
  const std::uint32_t candidates = light_candidates(path, from.p, true);
  if (scene_.lights.can_sample()) connect_sensor(path, from, sensor.normal, candidates);
  const std::array<float, 4> u = numbers_for_scattering(path);
  const Point2d disk = concentric_disk({static_cast<double>(u[0]), static_cast<double>(u[1])});
  const double cosine = safe_sqrt(1 - disk.x * disk.x - disk.y * disk.y);
  const Vector3d n = sensor.normal;
  const Vector3d x = normalize(cross(std::abs(n.x) < 0.5 ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0}, n));
  path.pdf = density_beside(cosine / pi, candidates);
  path.set(path_connected);
  ++path.depth;
  if (manifest_.settings.direct_only) path.depth |= scattered_once;
  depart(path, from, x * disk.x + cross(n, x) * disk.y + n * cosine);
  return path.pdf > 0;
}

}  // namespace vitrail
