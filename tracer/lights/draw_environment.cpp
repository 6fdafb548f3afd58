// SPDX-License-Identifier: Apache-2.0
// Images around the scene, and light that comes from everywhere alike: what a ray finds that leaves it.
#include <limits>

#include "tracer/lights/draw_light.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

bool draw_environment(const LightQuery& query, std::uint32_t environment, LightSample& sample) {
  const LightSampler& s = query.lights;
  sample.to_light = sample_direction(s.environments[environment], static_cast<double>(query.u[0]),
                                     static_cast<double>(query.u[1]));
  sample.distance = std::numeric_limits<double>::infinity();
  const Background seen = background(s, sample.to_light, query.wavelengths);
  if (!(seen.pdf > 0)) return false;
  sample.pdf = seen.pdf;
  sample.radiance = seen.radiance;
  sample.light = {LightKind::environment, environment};
  return true;
}

Background background(const LightSampler& s, Vector3d direction, const SampledWavelengths& wavelengths) {
  Background sum{filled(0)};
  for (const std::uint32_t i : s.infinite)
    sum.radiance =
        sum.radiance + evaluate(std::get<InfiniteLight>(s.scene.lights[i].model).radiance, wavelengths);
  for (std::uint32_t i = 0; i < s.environments.size(); ++i) {
    const EnvironmentValue value = value_towards(s.environments[i], direction, wavelengths);
    sum.radiance = sum.radiance + value.radiance;
    sum.pdf += s.share[s.numbers.choice({LightKind::environment, i})] * value.pdf;
  }
  return sum;
}

}  // namespace vitrail
