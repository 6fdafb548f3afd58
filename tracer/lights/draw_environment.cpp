// SPDX-License-Identifier: Apache-2.0
// Images around the scene, and light that comes from everywhere alike: what a ray finds that leaves it.
#include <limits>

#include "tracer/lights/draw_light.h"
#include "tracer/lights/environment_lanes.h"

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
  const lanes::Seen<double> seen =
      lanes::background<double>(s, {direction.x, direction.y, direction.z}, true,
                                [&](int) -> const SampledWavelengths& { return wavelengths; });
  return {lanes::lane(seen.radiance, 0), seen.pdf};
}

}  // namespace vitrail
