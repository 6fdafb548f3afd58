// SPDX-License-Identifier: Apache-2.0
// These functions give what emissive surfaces, triangles and quadrics alike, send from a point of them.
#pragma once

#include <algorithm>

#include "tracer/lights/light_sampler.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

// Returns the radiance of an area light by its record, whatever the surface's opacity is.
inline SampledSpectrum surface_radiance(const LightSampler& s, std::uint32_t area_light,
                                        const TexturePoint& at, const SampledWavelengths& wavelengths,
                                        LastLamp& last) {
  if (last.area_light == area_light) return last.radiance;
  const AreaLight& light = s.scene.area_lights[area_light];
  if (const auto* spectrum = std::get_if<Spectrum>(&light.radiance)) {
    last = {area_light, evaluate(*spectrum, wavelengths) * light.scale};
    return last.radiance;
  }
  if (!s.scene.textures) return filled(0);
  return s.scene.textures->spectrum(light.radiance, at, wavelengths) * light.scale;
}

// Returns how much of the surface there is. A surface of opacity 0 everywhere is a light that nothing meets,
// and shines as if it was whole.
inline float shining_share(const LightSampler& s, const FloatParameter& opacity, const TexturePoint& at) {
  if (const auto* constant = std::get_if<float>(&opacity))
    return is_invisible(opacity) ? 1 : std::clamp(*constant, 0.0f, 1.0f);
  if (!s.scene.textures) return 1;
  return static_cast<float>(std::clamp(s.scene.textures->number(opacity, at), 0.0, 1.0));
}

// Returns the radiance that leaves a slot's surface; `point()` gives its EmissivePoint.
template <class Point>
SampledSpectrum shining(const LightSampler& s, const LightSampler::Slot& t, const Point& point,
                        const SampledWavelengths& wavelengths, LastLamp& last) {
  const AreaLight& light = s.scene.area_lights[t.area_light];
  const auto all = [&](const TexturePoint& at) {
    return surface_radiance(s, t.area_light, at, wavelengths, last) * shining_share(s, t.opacity, at);
  };
  const bool constant =
      std::holds_alternative<Spectrum>(light.radiance) && std::holds_alternative<float>(t.opacity);
  return constant ? all({}) : all(point().point());
}

}  // namespace vitrail
