// SPDX-License-Identifier: Apache-2.0
#include "tracer/prepared/daylight_rows.h"

#include "scene/daylight/photometry.h"
#include "tracer/prepared/render_scene.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

const std::array<std::array<float, 3>, table_size>& observer_of(const RenderScene& scene) {
  static const auto with_melanopic = [] {
    std::array<std::array<float, 3>, table_size> observer = cie_1931();
    for (std::size_t i = 0; i < table_size; ++i) observer[i][2] = melanopic()[i];
    return observer;
  }();
  if (scene.daylight.any()) return with_melanopic;
  return scene.manifest.settings.rgb == RgbMethod::bands ? band_observer() : cie_1931();
}

void set_daylight(RenderScene& scene, DaylightRows rows) {
  scene.daylight = std::move(rows);
  if (scene.daylight.suns.empty()) return;
  for (LightSampler::Distant& light : scene.lights.distant) light.rows = scene.daylight.suns;
  for (LaneScene::Distant& light : scene.lanes.distant) light.is_plain = false;
}

}  // namespace vitrail
