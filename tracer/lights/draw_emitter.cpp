// SPDX-License-Identifier: Apache-2.0
// Lights that shine from one point; PointEmitter has their intensity.
#include <cmath>

#include "tracer/lights/draw_light.h"

namespace vitrail {

bool draw_emitter(const LightQuery& query, std::uint32_t emitter, LightSample& sample) {
  const LightSampler& s = query.lights;
  const PointEmitter& e = s.emitters[emitter];
  const Vector3d towards = e.position - query.p;
  const double distance2 = dot(towards, towards);
  if (!(distance2 > 0)) return false;
  sample.distance = std::sqrt(distance2);
  sample.to_light = towards * (1 / sample.distance);
  const auto weaken = static_cast<float>(e.fading ? weakened(e, sample.distance) : 1 / distance2);
  sample.radiance = intensity(e, -sample.to_light, s.scene.textures, query.wavelengths) * weaken;
  sample.pdf = 1;
  sample.is_delta = true;
  sample.light = {LightKind::emitter, emitter};
  return true;
}

}  // namespace vitrail
