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
    flux.push_back(lights.bounds_of_emitter(e).power);
    if (directions_of_.empty() || e.shape != lights.emitters[directions_of_.size() - 1].shape)
      directions_.emplace_back(*e.shape, lights.scene);
    directions_of_.push_back(static_cast<std::uint32_t>(directions_.size() - 1));
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
  guide_ = GuideTable(cumulative_, flux.size());
}

EmittedPhoton Emission::sample(const std::array<float, 4>& place, const std::array<float, 4>& way,
                               const SampledWavelengths& wavelengths) const {
  const double choice =
      std::min(static_cast<double>(place[2]) + static_cast<double>(place[3]) * 0x1p-24, 0x1.fffffffffffffp-1);
  const std::size_t number = guide_.bin(cumulative_, choice);
  const double share = cumulative_[number + 1] - cumulative_[number];
  const double rest = share > 0 ? (choice - cumulative_[number]) / share : 0;
  EmittedPhoton photon = of_light(lights_.numbers.light(number), std::clamp(rest, 0.0, 0x1.fffffffffffffp-1),
                                  place, way, wavelengths);
  photon.power = photon.power * static_cast<float>(1 / share);
  return photon;
}

EmittedPhoton Emission::of_light(LightRef light, double choice, const std::array<float, 4>& place,
                                 const std::array<float, 4>& way,
                                 const SampledWavelengths& wavelengths) const {
  switch (light.kind) {
    case LightKind::triangle:
      return leave_surface(on_triangle(light.index, choice, place, wavelengths), way);
    case LightKind::quadric:
      return leave_surface(on_quadric(light.index, place, wavelengths), way);
    case LightKind::emitter:
      return of_emitter(light.index, way, wavelengths);
    case LightKind::distant: {
      const LightSampler::Distant& d = lights_.distant[light.index];
      const Vector3d to_light = d.to_light(way[0], way[1]);
      EmittedPhoton photon =
          through_disc(-to_light, d.irradiance_from(to_light, wavelengths), place[0], place[1], way[2]);
      photon.is_distant = true;
      return photon;
    }
    case LightKind::environment: {
      const Environment& e = lights_.environments[light.index];
      const Vector3d to_light = sample_direction(e, static_cast<double>(way[0]), static_cast<double>(way[1]));
      const EnvironmentValue value = value_towards(e, to_light, wavelengths);
      return through_disc(-to_light, value.radiance * static_cast<float>(value.pdf > 0 ? 1 / value.pdf : 0),
                          place[0], place[1], way[2]);
    }
    case LightKind::infinite: {
      const auto& record = lights_.scene.lights[lights_.infinite[light.index]];
      const auto& infinite = std::get<InfiniteLight>(record.model);
      return through_disc(uniform_direction(way[0], way[1]),
                          evaluate(infinite.radiance, wavelengths) * static_cast<float>(4 * pi), place[0],
                          place[1], way[2]);
    }
  }
  return {};
}

Emission::Exit Emission::on_triangle(std::uint32_t triangle, double choice, const std::array<float, 4>& place,
                                     const SampledWavelengths& wavelengths) const {
  const TriangleParts* parts = lights_.parts_of_triangle(triangle);
  const TriangleParts::Place at =
      parts ? parts->choose(choice, place[0], place[1]) : uniform_place(place[0], place[1]);
  const EmissivePoint point(lights_.scene, triangle, at.b1, at.b2);
  const LightSampler::Face face = lights_.face(triangle);
  const EmissiveTriangle& t = lights_.scene.triangles[triangle];
  return {point.at.p,
          face.normal,
          face.area / at.density,
          &lights_.scene.area_lights[t.area_light],
          t.triangle,
          leaving(lights_, {LightKind::triangle, triangle}, point, wavelengths)};
}

Emission::Exit Emission::on_quadric(std::uint32_t index, const std::array<float, 4>& place,
                                    const SampledWavelengths& wavelengths) const {
  const QuadricLight& quadric = lights_.quadrics[index];
  const EmissiveQuadric& record = quadric.record();
  const Point3d local =
      point_by_area(record.quadric.quadric, static_cast<double>(place[0]), static_cast<double>(place[1]));
  const EmissivePoint point(quadric, local);
  const Vector3d front = placed_quadric_normal(record.quadric, record.to_bundle, local);
  return {point.at.p,
          front,
          quadric.area_by(front),
          &lights_.scene.area_lights[record.area_light],
          record.triangle,
          leaving(lights_, {LightKind::quadric, index}, point, wavelengths)};
}

EmittedPhoton Emission::leave_surface(const Exit& exit, const std::array<float, 4>& way) {
  EmittedPhoton photon;
  photon.p = exit.p;
  photon.triangle = exit.triangle;
  const double sides = exit.light->two_sided ? 2 : 1;
  photon.normal = exit.light->two_sided && way[2] >= 0.5f ? -exit.front : exit.front;
  if (exit.light->directional) {
    photon.direction = photon.normal;
    photon.power = exit.radiance * static_cast<float>(exit.area * sides);
    return photon;
  }
  photon.direction = Frame(photon.normal).to_world(sample_cosine_hemisphere(way[0], way[1]));
  photon.power = exit.radiance * static_cast<float>(pi * exit.area * sides);
  return photon;
}

EmittedPhoton Emission::of_emitter(std::uint32_t emitter, const std::array<float, 4>& way,
                                   const SampledWavelengths& wavelengths) const {
  const PointEmitter& e = lights_.emitters[emitter];
  EmittedPhoton photon;
  photon.p = e.position;
  if (e.fading) photon.fading = &e;
  const EmitterDirections::Way chosen = directions_[directions_of_[emitter]].sample(way[0], way[1], way[2]);
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
