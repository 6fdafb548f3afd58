// SPDX-License-Identifier: Apache-2.0
// Light of one direction, and suns.
#include <limits>

#include "scene/geometry/portable_math.h"
#include "tracer/lights/draw_light.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

Vector3d LightSampler::Distant::to_light(float u, float v) const {
  if (!sun) return -direction;
  return frame.to_world(sample_sun(*sun, static_cast<double>(u), static_cast<double>(v)));
}

SampledSpectrum LightSampler::Distant::irradiance_from(Vector3d to_light,
                                                       const SampledWavelengths& wavelengths) const {
  if (!sun) return evaluate(irradiance, wavelengths);
  return sun->sun(frame.to_light(to_light), wavelengths) *
         static_cast<float>(2 * pi * (1 - sun->sun_cosine()));
}

bool draw_distant(const LightQuery& query, std::uint32_t index, LightSample& sample) {
  const LightSampler::Distant& distant = query.lights.distant[index];
  sample.to_light = distant.to_light(query.far[0], query.far[1]);
  sample.distance = std::numeric_limits<double>::infinity();
  sample.radiance = distant.irradiance_from(sample.to_light, query.wavelengths);
  sample.pdf = 1;
  sample.is_delta = true;
  sample.light = {LightKind::distant, index};
  return true;
}

SampledSpectrum discs(const LightSampler& s, Vector3d direction, const SampledWavelengths& wavelengths) {
  SampledSpectrum sum;
  for (const std::uint32_t i : s.suns)
    if (const LightSampler::Distant& d = s.distant[i]; d.sun->meets_sun(d.frame.to_light(direction)))
      sum = sum + d.sun->sun(d.frame.to_light(direction), wavelengths);
  return sum;
}

}  // namespace vitrail
