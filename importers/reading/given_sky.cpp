// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/given_sky.h"

#include <fmt/format.h>

#include <cmath>

#include "importers/reading/default_view.h"
#include "scene/daylight/photometry.h"
#include "scene/records/light_traits.h"

namespace vitrail {

Transform sky_to_world(const std::string& up_name, const std::string& north_name) {
  const Vector3d up = axis_of(up_name), north = axis_of(north_name), east = cross(north, up);
  if (!(length(east) > 0))
    throw UsageError(fmt::format("--sky: up={} and north={} are along one axis", up_name, north_name));
  Transform t;
  t.m[0] = {east.x, north.x, up.x, 0};
  t.m[1] = {east.y, north.y, up.y, 0};
  t.m[2] = {east.z, north.z, up.z, 0};
  return t;
}

std::string up_of_camera(const Camera& camera) {
  const Transform to_world = std::visit([](const auto& c) { return c.camera_to_world; }, camera);
  const Vector3d up = normalize(transform_vector(to_world, {0, 1, 0})),
                 right = normalize(transform_vector(to_world, {1, 0, 0}));
  std::string best = "y";
  double most = 0;
  for (const bool level : {true, false}) {
    for (const char* name : {"y", "z", "x", "-y", "-z", "-x"}) {
      const double rises = dot(axis_of(name), up);
      if (rises > most + 1e-6 && (!level || std::abs(dot(axis_of(name), right)) < 1e-3))
        most = rises, best = name;
    }
    if (most > 0.1) break;
  }
  return best;
}

namespace {

// cd/m² of surfaces; a point's cd count as if they came from a square decimetre.
double brightness_of(const Scene& scene) {
  double most = 0;
  const auto see = [&](const SpectrumParameter& p, double factor) {
    if (const auto* spectrum = std::get_if<Spectrum>(&p))
      most = std::max(most, photometric(luminance(*spectrum)) * factor);
  };
  for (const AreaLight& light : scene.area_lights) see(light.radiance, 1);
  for (const Light& light : scene.lights) {
    if (const auto* point = std::get_if<PointLight>(&light.model)) see(point->intensity, 100);
    if (const auto* spot = std::get_if<SpotLight>(&light.model)) see(spot->intensity, 100);
  }
  return most;
}

void note_lamps(ImportedScene& imported) {
  constexpr double luminaires = 2e4;
  const double most = brightness_of(imported.scene);
  if (most <= luminaires) return;
  imported.diagnostics.push_back(
      {Fidelity::approximated,
       fmt::format(
           "beside --sky the scene's own lamps count as W/(m2 sr nm): the brightest has {:.2g} cd/m2, the "
           "clear sky some 1e4, a luminaire less; if the scene has units of its own, scale its lamps or "
           "leave them out",
           most)});
}

}  // namespace

void replace_sky(ImportedScene& imported, const GivenSky& sky) {
  Scene& scene = imported.scene;
  // Where there was no light, the scene loses none.
  const bool was_added = std::erase_if(imported.diagnostics, [](const Diagnostic& d) {
                           return d.message == sky_is_added || d.message == sky_is_added_to_lamps;
                         }) > 0;
  std::vector<Light> kept;
  for (Light& light : scene.lights) {
    if (!traits_of(light.model).is_far()) {
      kept.push_back(std::move(light));
      continue;
    }
    if (was_added) continue;
    const SourceLocation place = location(scene, light.origin);
    imported.diagnostics.push_back({Fidelity::dropped, "light from infinitely far: --sky stands for it",
                                    place, place, RecordKind::light});
  }
  scene.lights = std::move(kept);
  const std::string up = sky.up.empty() ? up_of_camera(scene.camera) : sky.up;
  if (sky.up.empty() && up != "y")
    imported.diagnostics.push_back(
        {Fidelity::approximated, fmt::format("--sky: up={} by the camera; with up=… another axis is", up)});
  note_lamps(imported);
  SkyLight light = sky.light;
  const char* usual = up.ends_with('y') ? "-z" : "y";
  light.light_to_world = sky_to_world(up, sky.north.empty() ? usual : sky.north);
  scene.lights.push_back({light, {}});
}

}  // namespace vitrail
