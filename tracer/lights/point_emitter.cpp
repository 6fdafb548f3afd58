// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/point_emitter.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/models/fading.h"
#include "tracer/lights/environment.h"
#include "tracer/lights/point_emitter_lanes.h"
#include "tracer/lights/projected_flux.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

namespace {

constexpr double radians = pi / 180;

SampledSpectrum value_of(const SpectrumParameter& parameter, const TexturePoint& at, const Textures* textures,
                         const SampledWavelengths& wavelengths) {
  if (const auto* spectrum = std::get_if<Spectrum>(&parameter)) return evaluate(*spectrum, wavelengths);
  return textures ? textures->spectrum(parameter, at, wavelengths) : filled(0);
}

// The part of the intensity that depends on the direction (x,y,z), unit, in the light's frame.
struct DirectionalPart {
  Vector3d d;
  const Textures* textures;
  const SampledWavelengths& wavelengths;

  SampledSpectrum operator()(const SpotShape& spot) const {
    const auto falling =
        static_cast<float>(lanes::spot_part(d.z, [&](int) -> const SpotShape& { return spot; }));
    if (!spot.texture || !(d.z > 0)) return filled(falling);
    const double scale = 0.5 / (d.z * spot.frame);
    const TexturePoint at{{0.5 + d.x * scale, 0.5 + d.y * scale}, {}, {}};
    return value_of(*spot.texture, at, textures, wavelengths) * falling;
  }

  SampledSpectrum operator()(const ProjectionShape& p) const {
    if (!(d.z > 1e-9)) return filled(0);
    const double s = 0.5 + 0.5 * d.x / (d.z * p.half.x), t = 0.5 + 0.5 * d.y / (d.z * p.half.y);
    if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return filled(0);
    // Mitsuba's textures count v from the top.
    const TexturePoint at{{s, p.irradiance ? 1 - t : t}, {}, {}};
    const SampledSpectrum image = value_of(p.image, at, textures, wavelengths);
    // Mitsuba's numbers are the radiance of a white diffuse plane at z = 1: E = π·image = I cos³θ.
    return p.irradiance ? image * static_cast<float>(pi / (d.z * d.z * d.z)) : image;
  }

  // The map's +z is the light's +y (pbrt).
  SampledSpectrum operator()(const GoniometricShape& g) const {
    return look_up(*g.image, g.projection(), sphere_point(g.projection(), {d.x, d.z, d.y}), wavelengths);
  }
};

bool is_rigid(const Transform& t) {
  const auto column = [&](Vector3d axis) { return transform_vector(t, axis); };
  const Vector3d x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
  const double s = dot(z, z);
  return std::abs(dot(x, x) - s) < 1e-6 * s && std::abs(dot(y, y) - s) < 1e-6 * s &&
         std::abs(dot(x, y)) < 1e-6 * s && std::abs(dot(y, z)) < 1e-6 * s && std::abs(dot(z, x)) < 1e-6 * s;
}

EmitterShape placed(const Transform& light_to_world) {
  EmitterShape s;
  if (is_invertible(light_to_world)) s.world_to_light = inverse(light_to_world);
  s.axis = normalize(transform_vector(light_to_world, {0, 0, 1}));
  if (!(length(s.axis) > 0.5)) s.axis = {0, 0, 1};
  s.is_rigid = is_rigid(light_to_world);
  return s;
}

void bound_all_around(EmitterShape& s) { s.theta_o_rad = pi, s.theta_e_rad = pi / 2; }

// Light within `half_rad` of the axis: all of the cone counts alike, and nothing outside of it.
void bound_cone(EmitterShape& s, double half_rad) {
  s.theta_o_rad = s.is_rigid ? std::min(pi, half_rad + 0.01) : pi;
  s.theta_e_rad = s.theta_o_rad < pi ? 0.01 : pi / 2;
}

const std::shared_ptr<const EmitterShape>& to_all_sides() {
  static const std::shared_ptr<const EmitterShape> shape = [] {
    EmitterShape s;
    SpotShape all;
    all.cos_beam = -2, all.cos_cutoff = -3;
    s.kind = all;
    bound_all_around(s);
    return std::make_shared<const EmitterShape>(s);
  }();
  return shape;
}

PointEmitter emitter(Point3d position, const Spectrum& intensity, EmitterShape shape, double flux) {
  return {.position = position,
          .intensity = &intensity,
          .shape = std::make_shared<const EmitterShape>(std::move(shape)),
          .flux = flux};
}
Point3d origin_of(const Transform& light_to_world) { return transform_point(light_to_world, {0, 0, 0}); }

const Fading* fading_of(const std::optional<Fading>& fading) { return fading ? &*fading : nullptr; }

}  // namespace

double weakened(const PointEmitter& e, double distance) {
  return e.fading ? weakened(*e.fading, distance) : 1 / (distance * distance);
}

// At d ≥ d0, 2/(1 + (d/d0)^p) ≤ 2(d0/d)² where p ≥ 2; nowhere more than 2.
LightBounds bounds_of(const PointEmitter& e, double farthest) {
  LightBounds b;
  extend(b.box, e.position);
  b.axis = e.shape->axis;
  b.theta_o_rad = e.shape->theta_o_rad, b.theta_e_rad = e.shape->theta_e_rad;
  b.power = e.flux;
  if (!e.fading) return b;
  const bool by_squares = weakens(*e.fading) && e.fading->fade_power >= 2;
  b.near = by_squares ? std::min(static_cast<double>(e.fading->fade_distance), farthest) : farthest;
  b.power *= (weakens(*e.fading) ? 2 : 1) * (b.near * b.near);
  return b;
}

SampledSpectrum intensity(const PointEmitter& e, Vector3d direction, const Textures* textures,
                          const SampledWavelengths& wavelengths) {
  const Vector3d local = normalize(transform_vector(e.shape->world_to_light, direction));
  const SampledSpectrum part = std::visit(DirectionalPart{local, textures, wavelengths}, e.shape->kind);
  if (is_black(part)) return filled(0);
  return part * (evaluate(*e.intensity, wavelengths) * e.shape->factor);
}

PointEmitter make_emitter(const PointLight& light) {
  return {.position = light.position,
          .intensity = &light.intensity,
          .fading = fading_of(light.fading),
          .shape = to_all_sides(),
          .flux = 4 * pi * luminance(light.intensity)};
}

PointEmitter make_emitter(const SpotLight& light, const Textures* textures,
                          std::span<const Texture> records) {
  EmitterShape shape = placed(light.light_to_world);
  SpotShape spot;
  spot.falloff = light.falloff;
  spot.tightness = static_cast<double>(light.tightness);
  spot.cutoff_rad = std::clamp(static_cast<double>(light.cutoff_deg) * radians, 0.0, pi);
  spot.beam_rad = std::clamp(static_cast<double>(light.beam_deg) * radians, 0.0, spot.cutoff_rad);
  spot.cos_cutoff = portable_cos(spot.cutoff_rad);
  // A negative power of the cosine grows without bound towards a right angle: up to 10³⁶, which floats have.
  if (spot.tightness < 0)
    spot.cos_cutoff = std::max(spot.cos_cutoff, portable_pow(10.0, 36 / spot.tightness));
  spot.cos_beam = std::max(portable_cos(spot.beam_rad), spot.cos_cutoff);
  spot.texture = light.texture;
  spot.frame = std::max(1e-9, portable_tan(std::min(spot.cutoff_rad, 0.4999 * pi)));
  // The falloff over cosines has the mean 1/2, and 1/5 where it is quartic; linear in the angle: nearly 1/2.
  const double mean = spot.falloff == SpotLight::Falloff::quartic ? 0.2 : 0.5;
  double flux =
      2 * pi * (1 - spot.cos_beam + mean * (spot.cos_beam - spot.cos_cutoff)) * luminance(light.intensity);
  // As if the beam was all of the cone: ∫ 2π x^t dx.
  if (spot.tightness != 0 && spot.cos_cutoff >= 0) {
    double power = spot.tightness + 1;
    if (std::abs(power) < 1e-6) power = 1e-6;  // as a logarithm
    flux *= (1 - portable_pow(spot.cos_cutoff, power)) / (power * std::max(1 - spot.cos_cutoff, 1e-12));
  }
  if (spot.texture) flux *= mean_over_frame(*spot.texture, textures, records);
  bound_cone(shape, spot.cutoff_rad);
  shape.kind = spot;
  PointEmitter e = emitter(origin_of(light.light_to_world), light.intensity, std::move(shape), flux);
  e.fading = fading_of(light.fading);
  return e;
}

PointEmitter make_emitter(const ProjectionLight& light, double aspect, const Textures* textures,
                          std::span<const Texture> records) {
  EmitterShape shape = placed(light.light_to_world);
  ProjectionShape p;
  p.image = light.image;
  p.irradiance = light.irradiance;
  if (!(aspect > 0)) aspect = 1;
  const double fov = std::clamp(static_cast<double>(light.fov_deg), 1e-3, 179.9);
  const double half = portable_tan(fov / 2 * radians);
  p.half = light.irradiance || aspect < 1 ? Point2d{half, half / aspect} : Point2d{half * aspect, half};

  const double flux = projected_flux(light, p.half, textures, records);
  if (light.power && flux > 0) shape.factor = static_cast<float>(static_cast<double>(*light.power) / flux);
  const double whole = flux * static_cast<double>(shape.factor) * luminance(light.scale);
  const double corner = std::sqrt(p.half.x * p.half.x + p.half.y * p.half.y);
  bound_cone(shape, portable_atan2(corner, 1));
  shape.kind = p;
  return emitter(origin_of(light.light_to_world), light.scale, std::move(shape), whole);
}

PointEmitter make_emitter(const GoniometricLight& light, std::shared_ptr<const LightImage> image) {
  EmitterShape shape = placed(light.light_to_world);
  const GoniometricShape goniometric{std::move(image), light.latitude_longitude};
  const double flux = flux_of(*goniometric.image, goniometric.projection(), false);
  if (light.power && flux > 0) shape.factor = static_cast<float>(static_cast<double>(*light.power) / flux);
  const double whole = flux * static_cast<double>(shape.factor) * luminance(light.intensity);
  bound_all_around(shape);
  shape.kind = goniometric;
  return emitter(origin_of(light.light_to_world), light.intensity, std::move(shape), whole);
}

}  // namespace vitrail
