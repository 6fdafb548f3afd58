// SPDX-License-Identifier: Apache-2.0
#include "bundle/light_names.h"

#include <fmt/format.h>

#include "scene/records/kinds.h"

namespace vitrail {

LightNames light_names(const Manifest& m) {
  LightNames names;
  std::size_t number = 0;
  while (number < m.area_lights.size()) names.area_lights.push_back(fmt::format("area-{}", ++number));
  for (const Light& light : m.lights)
    names.lights.push_back(fmt::format("{}-{}", kind_of(light.model), ++number));
  for (const Medium& medium : m.media) {
    const bool shines = medium.emission || medium.temperature;
    names.media.push_back(shines ? fmt::format("medium-{}", names.media.size() + 1) : "");
  }
  return names;
}

}  // namespace vitrail
