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

  SampledSpectrum operator()(const PointEmitter::Everywhere&) const { return filled(1); }

  SampledSpectrum operator()(const PointEmitter::Spot& spot) const {
    const auto falling =
        static_cast<float>(lanes::spot_part(d.z, [&](int) -> const PointEmitter::Spot& { return spot; }));
    if (!spot.texture || !(d.z > 0)) return filled(falling);
    const double scale = 0.5 / (d.z * spot.frame);
    const TexturePoint at{{0.5 + d.x * scale, 0.5 + d.y * scale}, {}, {}};
    return value_of(*spot.texture, at, textures, wavelengths) * falling;
  }

  SampledSpectrum operator()(const PointEmitter::Projection& p) const {
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
  SampledSpectrum operator()(const PointEmitter::Goniometric& g) const {
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

PointEmitter placed(const Transform& light_to_world) {
  PointEmitter e;
  e.position = transform_point(light_to_world, {0, 0, 0});
  if (is_invertible(light_to_world)) e.world_to_light = inverse(light_to_world);
  e.bounds.axis = normalize(transform_vector(light_to_world, {0, 0, 1}));
  if (!(length(e.bounds.axis) > 0.5)) e.bounds.axis = {0, 0, 1};
  extend(e.bounds.box, e.position);
  e.is_rigid = is_rigid(light_to_world);
  return e;
}

// Light within `half_rad` of the axis: all of the cone counts alike, and nothing outside of it.
void bound_cone(PointEmitter& e, double half_rad) {
  e.bounds.theta_o_rad = e.is_rigid ? std::min(pi, half_rad + 0.01) : pi;
  e.bounds.theta_e_rad = e.bounds.theta_o_rad < pi ? 0.01 : pi / 2;
}

}  // namespace

double weakened(const PointEmitter& e, double distance) {
  return e.fading ? weakened(*e.fading, distance) : 1 / (distance * distance);
}

// At d ≥ d0, 2/(1 + (d/d0)^p) ≤ 2(d0/d)² where p ≥ 2; nowhere more than 2.
void bound_fading(PointEmitter& e, double farthest) {
  if (!e.fading) return;
  const bool by_squares = weakens(*e.fading) && e.fading->fade_power >= 2;
  e.bounds.near = by_squares ? std::min(static_cast<double>(e.fading->fade_distance), farthest) : farthest;
  e.bounds.power *= (weakens(*e.fading) ? 2 : 1) * (e.bounds.near * e.bounds.near);
}

SampledSpectrum intensity(const PointEmitter& e, Vector3d direction, const Textures* textures,
                          const SampledWavelengths& wavelengths) {
  const Vector3d local = normalize(transform_vector(e.world_to_light, direction));
  const SampledSpectrum part = std::visit(DirectionalPart{local, textures, wavelengths}, e.shape);
  if (is_black(part)) return filled(0);
  return part * (evaluate(e.intensity, wavelengths) * e.factor);
}

std::optional<PlainEmitter> plain_emitter(const PointEmitter& e) {
  const auto* spot = std::get_if<PointEmitter::Spot>(&e.shape);
  if (!std::holds_alternative<PointEmitter::Everywhere>(e.shape) && (!spot || spot->texture)) return {};
  PlainEmitter plain;
  plain.position = e.position;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = e.world_to_light.m[i];
    plain.to_local[i] = {row[0], row[1], row[2]};
  }
  if (spot)
    plain.spot = *spot;
  else
    plain.spot.cos_beam = -2, plain.spot.cos_cutoff = -3;
  plain.fades = e.fading.has_value();
  if (e.fading && weakens(*e.fading)) {
    plain.fade_distance = static_cast<double>(e.fading->fade_distance);
    plain.fade_power = static_cast<double>(e.fading->fade_power);
  }
  plain.intensity = flat_spectrum(e.intensity, e.factor);
  return plain;
}

PointEmitter make_emitter(const PointLight& light) {
  PointEmitter e;
  e.position = light.position;
  extend(e.bounds.box, e.position);
  e.intensity = light.intensity;
  e.fading = light.fading;
  e.bounds.theta_o_rad = pi;
  e.bounds.theta_e_rad = pi / 2;
  e.bounds.power = 4 * pi * luminance(light.intensity);
  return e;
}

PointEmitter make_emitter(const SpotLight& light, const Textures* textures,
                          std::span<const Texture> records) {
  PointEmitter e = placed(light.light_to_world);
  e.intensity = light.intensity;
  e.fading = light.fading;
  PointEmitter::Spot spot;
  spot.falloff = light.falloff;
  spot.tightness = static_cast<double>(light.tightness);
  spot.cutoff_rad = std::clamp(static_cast<double>(light.cutoff_deg) * radians, 0.0, pi);
  spot.beam_rad = std::clamp(static_cast<double>(light.beam_deg) * radians, 0.0, spot.cutoff_rad);
  spot.cos_cutoff = portable_cos(spot.cutoff_rad);
  spot.cos_beam = portable_cos(spot.beam_rad);
  spot.texture = light.texture;
  spot.frame = std::max(1e-9, portable_tan(std::min(spot.cutoff_rad, 0.4999 * pi)));
  // The falloff over cosines has the mean 1/2, and 1/5 where it is quartic; linear in the angle: nearly 1/2.
  const double mean = spot.falloff == SpotLight::Falloff::quartic ? 0.2 : 0.5;
  e.bounds.power =
      2 * pi * (1 - spot.cos_beam + mean * (spot.cos_beam - spot.cos_cutoff)) * luminance(e.intensity);
  // As if the beam was all of the cone: ∫ 2π x^t dx.
  if (spot.tightness > 0 && spot.cos_cutoff >= 0)
    e.bounds.power *= (1 - portable_pow(spot.cos_cutoff, spot.tightness + 1)) /
                      ((spot.tightness + 1) * std::max(1 - spot.cos_cutoff, 1e-12));
  if (spot.texture) e.bounds.power *= mean_over_frame(*spot.texture, textures, records);
  bound_cone(e, spot.cutoff_rad);
  e.shape = spot;
  return e;
}

PointEmitter make_emitter(const ProjectionLight& light, double aspect, const Textures* textures,
                          std::span<const Texture> records) {
  PointEmitter e = placed(light.light_to_world);
  e.intensity = light.scale;
  PointEmitter::Projection p;
  p.image = light.image;
  p.irradiance = light.irradiance;
  if (!(aspect > 0)) aspect = 1;
  const double fov = std::clamp(static_cast<double>(light.fov_deg), 1e-3, 179.9);
  const double half = portable_tan(fov / 2 * radians);
  p.half = light.irradiance || aspect < 1 ? Point2d{half, half / aspect} : Point2d{half * aspect, half};

  const double flux = projected_flux(light, p.half, textures, records);
  if (light.power && flux > 0) e.factor = static_cast<float>(static_cast<double>(*light.power) / flux);
  e.bounds.power = flux * static_cast<double>(e.factor) * luminance(light.scale);
  const double corner = std::sqrt(p.half.x * p.half.x + p.half.y * p.half.y);
  bound_cone(e, portable_atan2(corner, 1));
  e.shape = p;
  return e;
}

PointEmitter make_emitter(const GoniometricLight& light, std::shared_ptr<const LightImage> image) {
  PointEmitter e = placed(light.light_to_world);
  e.intensity = light.intensity;
  const PointEmitter::Goniometric goniometric{std::move(image), light.latitude_longitude};
  const double flux = flux_of(*goniometric.image, goniometric.projection(), false);
  if (light.power && flux > 0) e.factor = static_cast<float>(static_cast<double>(*light.power) / flux);
  e.bounds.power = flux * static_cast<double>(e.factor) * luminance(light.intensity);
  e.bounds.theta_o_rad = pi;
  e.bounds.theta_e_rad = pi / 2;
  e.shape = goniometric;
  return e;
}

}  // namespace vitrail
