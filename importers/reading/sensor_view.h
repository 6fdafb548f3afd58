// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/camera.h"
#include "scene/records/film_settings.h"

namespace vitrail {

// Returns a camera for formats without sensors: it shows what the first sensor sees ahead, at 90 degrees.
inline PerspectiveCamera view_of(const SensorCamera& camera, const FilmSettings& film) {
  const Sensor sensor = camera.sensors.empty() ? Sensor{} : camera.sensors.front();
  const Vector3d z = sensor.normal;
  const Vector3d x = unit(cross(std::abs(z.y) < 0.9 ? Vector3d{0, 1, 0} : Vector3d{0, 0, 1}, z)),
                 y = cross(z, x);
  const Point3d p = sensor.position;
  Transform t;
  t.m[0] = {x.x, y.x, z.x, p.x};
  t.m[1] = {x.y, y.y, z.y, p.y};
  t.m[2] = {x.z, y.z, z.z, p.z};
  const double height = static_cast<double>(film.height) / film.width;
  return {camera.camera_to_world * t, {-1, 1, -height, height}, {}};
}

}  // namespace vitrail
