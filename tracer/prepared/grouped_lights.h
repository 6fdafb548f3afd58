// SPDX-License-Identifier: Apache-2.0
// A GroupedLights says which light belongs to which of the groups that a film keeps apart
// (film/light_groups.h).
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/lights/light_sampler.h"

namespace vitrail {

// They are numbers of groups, by the indices of a manifest's records; all are empty where nothing is kept
// apart.
struct GroupedLights {
  std::vector<std::uint8_t> area_lights, lights, media;
  bool kept_apart = false;
  // Light from all around belongs to several groups where its lights do: the direction then tells the group.
  static constexpr std::uint8_t by_direction = 0xff;
  std::uint8_t surroundings = 0;  // their group, or by_direction

  // Returns the group of a light: 0 where nothing is kept apart.
  std::uint8_t of(const LightSampler& sampler, LightRef light) const;
  std::uint8_t of_area_light(std::uint32_t area_light) const {
    return kept_apart ? area_lights[area_light] : std::uint8_t{0};
  }
};

}  // namespace vitrail
