// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/surface_shine.h"

namespace vitrail {

TexturePoint EmissivePoint::point() const {
  TexturePoint result = at;
  result.attributes = std::span(attributes).first(attribute_count);
  return result;
}

SampledSpectrum emitted(const LightSampler& s, std::uint32_t area_light, const TexturePoint& at,
                        double cosine, const SampledWavelengths& wavelengths, LastLamp& last) {
  const AreaLight& light = s.scene.area_lights[area_light];
  if (light.directional || (cosine <= 0 && !light.two_sided)) return filled(0);
  return surface_radiance(s, area_light, at, wavelengths, last);
}

SampledSpectrum emitted(const LightSampler& s, std::uint32_t area_light, const TexturePoint& at,
                        double cosine, const SampledWavelengths& wavelengths) {
  LastLamp last;
  return emitted(s, area_light, at, cosine, wavelengths, last);
}

SampledSpectrum leaving(const LightSampler& s, LightRef light, const EmissivePoint& point,
                        const SampledWavelengths& wavelengths) {
  assert(light.kind <= LightKind::quadric);
  LastLamp last;
  if (light.kind == LightKind::quadric) {
    const EmissiveQuadric& q = s.quadrics[light.index].record();
    return surface_radiance(s, q.area_light, point.point(), wavelengths, last) *
           shining_share(s, q.opacity, point.point());
  }
  const SampledSpectrum radiance =
      surface_radiance(s, s.scene.triangles[light.index].area_light, point.point(), wavelengths, last);
  if (s.scene.opacities.empty()) return radiance;
  return radiance * shining_share(s, s.scene.opacities[light.index], point.point());
}

}  // namespace vitrail
