// SPDX-License-Identifier: Apache-2.0
#include "tracer/prepared/grouped_lights.h"

namespace vitrail {

std::uint8_t GroupedLights::of(const LightSampler& sampler, LightRef light) const {
  if (!kept_apart) return 0;
  switch (light.kind) {
    case LightKind::triangle:
      return area_lights[sampler.scene.triangles[light.index].area_light];
    case LightKind::quadric:
      return area_lights[sampler.scene.quadrics[light.index].area_light];
    case LightKind::emitter:
      return lights[sampler.emitters[light.index].light];
    case LightKind::distant:
      return lights[sampler.distant[light.index].light];
    case LightKind::environment:
    case LightKind::infinite:
      break;  // a sample of one brings what is there of all
  }
  return surroundings;
}

}  // namespace vitrail
