// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/emission.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/lights/surface_lights.h"
#include "tracer/quadrics/quadric_surface.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

namespace {

Vector3d uniform_direction(float u, float v) {
  const double z = 1 - 2 * static_cast<double>(u), r = safe_sqrt(1 - z * z);
  const double phi = 2 * pi * static_cast<double>(v);
  return {r * portable_cos(phi), r * portable_sin(phi), z};
}

}  // namespace

Emission::Emission(const LightSampler& lights, const Bounds3f& bounds, Point3d eye) : lights_(lights) {
  spheres_.push_back({});
  if (!bounds.empty()) {
    constexpr int most_spheres = 4;
    const Point3d lower = cast<double>(bounds.lower), upper = cast<double>(bounds.upper);
    const double radius = length(upper - lower) / 2 * (1 + 1e-6);
    spheres_[0] = {lower + (upper - lower) * 0.5, radius};
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
      within = within && lower[axis] <= eye[axis] && eye[axis] <= upper[axis];
    for (int i = 1; within && i < most_spheres; ++i) spheres_.push_back({eye, std::ldexp(radius, -2 * i)});
  }
  // By what comes near the eye: else a sun over all of a wide scene would leave no photons to its lamps.
  const double disc = pi * spheres_.back().radius * spheres_.back().radius;
  std::vector<double> flux;
  for (const LightBounds& b : surface_lights(lights.scene, lights.quadrics).bounds) flux.push_back(b.power);
  for (const PointEmitter& e : lights.emitters) {
    flux.push_back(e.bounds.power);
    directions_.emplace_back(e, lights.scene);
  }
  for (const LightSampler::Distant& d : lights.distant) flux.push_back(disc * luminance(d.irradiance));
  for (const Environment& e : lights.environments) flux.push_back(disc * 4 * pi * e.mean_luminance);
  for (const std::uint32_t i : lights.infinite)
    flux.push_back(disc * 4 * pi * luminance(std::get<InfiniteLight>(lights.scene.lights[i].model).radiance));
  for (double& f : flux) {
    if (!(f > 0) || !std::isfinite(f)) f = 0;
    flux_ += f;
  }
  if (!(flux_ > 0)) return;
  constexpr double least_share = 1e-9;  // what shines is chosen now and then
  for (double& f : flux)
    if (f > 0) f = std::max(f, least_share * flux_);
  cumulative_.push_back(0);
  for (const double f : flux) cumulative_.push_back(cumulative_.back() + f / flux_);
  for (double& sum : cumulative_) sum /= cumulative_.back();
  guide_ = GuideTable(cumulative_, std::min<std::size_t>(flux.size(), 1 << 16));
}

EmittedPhoton Emission::sample(const std::array<float, 4>& place, const std::array<float, 4>& way,
                               const SampledWavelengths& wavelengths) const {
  const double choice =
      std::min(static_cast<double>(place[2]) + static_cast<double>(place[3]) * 0x1p-24, 0x1.fffffffffffffp-1);
  std::size_t index = guide_.bin(cumulative_, choice);
  const double share = cumulative_[index + 1] - cumulative_[index];
  const auto chosen = [&]() -> EmittedPhoton {
    const std::size_t surfaces = lights_.scene.triangles.size() + lights_.quadrics.size();
    if (index < surfaces) {
      const double rest = share > 0 ? (choice - cumulative_[index]) / share : 0;
      return of_surface(index, std::clamp(rest, 0.0, 0x1.fffffffffffffp-1), place, way, wavelengths);
    }
    index -= surfaces;
    if (index < lights_.emitters.size()) return of_emitter(index, way, wavelengths);
    index -= lights_.emitters.size();
    if (index < lights_.distant.size()) {
      const LightSampler::Distant& d = lights_.distant[index];
      const Vector3d to_light = d.to_light(way[0], way[1]);
      EmittedPhoton photon =
          through_disc(-to_light, d.irradiance_from(to_light, wavelengths), place[0], place[1], way[2]);
      photon.is_distant = true;
      return photon;
    }
    index -= lights_.distant.size();
    if (index < lights_.environments.size()) {
      const Environment& e = lights_.environments[index];
      const Vector3d to_light = sample_direction(e, static_cast<double>(way[0]), static_cast<double>(way[1]));
      const EnvironmentValue value = value_towards(e, to_light, wavelengths);
      return through_disc(-to_light, value.radiance * static_cast<float>(value.pdf > 0 ? 1 / value.pdf : 0),
                          place[0], place[1], way[2]);
    }
    index -= lights_.environments.size();
    const auto& light = std::get<InfiniteLight>(lights_.scene.lights[lights_.infinite[index]].model);
    return through_disc(uniform_direction(way[0], way[1]),
                        evaluate(light.radiance, wavelengths) * static_cast<float>(4 * pi), place[0],
                        place[1], way[2]);
  };
  EmittedPhoton photon = chosen();
  photon.power = photon.power * static_cast<float>(1 / share);
  return photon;
}

EmittedPhoton Emission::of_surface(std::size_t light, double choice, const std::array<float, 4>& place,
                                   const std::array<float, 4>& way,
                                   const SampledWavelengths& wavelengths) const {
  EmittedPhoton photon;
  const std::size_t triangles = lights_.scene.triangles.size();
  double area = 0;
  Vector3d front;
  const AreaLight* record = nullptr;
  if (light < triangles) {
    const TriangleParts* parts = lights_.parts_of_triangle(light);
    const TriangleParts::Place at =
        parts ? parts->choose(choice, place[0], place[1]) : uniform_place(place[0], place[1]);
    const EmissivePoint point(lights_.scene, light, at.b1, at.b2);
    const LightSampler::Face face = lights_.face(light);
    const EmissiveTriangle& t = lights_.scene.triangles[light];
    record = &lights_.scene.area_lights[t.area_light];
    area = face.area / at.density;
    front = face.normal;
    photon.p = point.at.p;
    photon.triangle = t.triangle;
    photon.power = leaving(lights_, light, point, wavelengths);
  } else {
    const QuadricLight& quadric = lights_.quadrics[light - triangles];
    const Point3d local = point_by_area(quadric.record().quadric.quadric, static_cast<double>(place[0]),
                                        static_cast<double>(place[1]));
    const EmissivePoint point(quadric, local);
    record = &lights_.scene.area_lights[quadric.record().area_light];
    front = placed_quadric_normal(quadric.record().quadric, quadric.record().to_bundle, local);
    area = quadric.area_by(front);
    photon.p = point.at.p;
    photon.triangle = quadric.record().triangle;
    photon.power = leaving(lights_, light, point, wavelengths);
  }
  double sides = 1;
  if (record->two_sided) {
    sides = 2;
    if (way[2] >= 0.5f) front = -front;
  }
  photon.normal = front;
  if (record->directional) {
    photon.direction = front;
    photon.power = photon.power * static_cast<float>(area * sides);
    return photon;
  }
  photon.direction = Frame(front).to_world(sample_cosine_hemisphere(way[0], way[1]));
  photon.power = photon.power * static_cast<float>(pi * area * sides);
  return photon;
}

EmittedPhoton Emission::of_emitter(std::size_t emitter, const std::array<float, 4>& way,
                                   const SampledWavelengths& wavelengths) const {
  const PointEmitter& e = lights_.emitters[emitter];
  EmittedPhoton photon;
  photon.p = e.position;
  const EmitterDirections::Way chosen = directions_[emitter].sample(way[0], way[1], way[2]);
  photon.direction = chosen.direction;
  if (!(chosen.pdf > 0)) return photon;
  photon.power = intensity(e, photon.direction, lights_.scene.textures, wavelengths) *
                 static_cast<float>(1 / chosen.pdf);
  return photon;
}

EmittedPhoton Emission::through_disc(Vector3d direction, const SampledSpectrum& irradiance, float u, float v,
                                     float choice) const {
  const double count = static_cast<double>(spheres_.size());
  const Sphere& sphere = spheres_[static_cast<std::size_t>(static_cast<double>(choice) * count)];
  const double r = sphere.radius * std::sqrt(static_cast<double>(u)), phi = 2 * pi * static_cast<double>(v);
  EmittedPhoton photon;
  photon.direction = direction;
  photon.p = sphere.centre + Frame(direction).to_world({r * portable_cos(phi), r * portable_sin(phi), 0});
  // Per area across the direction, of all discs that it may have come through.
  double pdf = 0;
  for (const Sphere& s : spheres_)
    if (&s == &sphere || length(cross(photon.p - s.centre, direction)) < s.radius)
      pdf += 1 / (count * pi * s.radius * s.radius);
  photon.power = irradiance * static_cast<float>(1 / pdf);
  // From outside of the scene.
  const Sphere& scene = spheres_[0];
  photon.p = photon.p - direction * (dot(photon.p - scene.centre, direction) + 1.01 * scene.radius);
  return photon;
}

}  // namespace vitrail
