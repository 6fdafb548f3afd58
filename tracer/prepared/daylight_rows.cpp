// SPDX-License-Identifier: Apache-2.0
#include "tracer/prepared/daylight_rows.h"

#include "tracer/prepared/render_scene.h"

namespace vitrail {

void set_daylight(RenderScene& scene, DaylightRows rows) {
  scene.daylight = std::move(rows);
  if (scene.daylight.suns.empty()) return;
  for (LightSampler::Distant& light : scene.lights.distant) light.rows = scene.daylight.suns;
  for (LaneScene::Distant& light : scene.lanes.distant) light.is_plain = false;
}

}  // namespace vitrail
