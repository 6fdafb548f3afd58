// SPDX-License-Identifier: Apache-2.0
#include "bundle/light_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/records/kinds.h"

namespace vitrail {

namespace {

constexpr std::size_t most_bytes = 64;

}  // namespace

std::string typed_name(std::string name) {
  name.resize(std::min(name.size(), most_bytes));
  std::ranges::replace_if(
      name, [](unsigned char c) { return c <= ' ' || c == 0x7f || c == ',' || c == '='; }, '_');
  return name;
}

LightNames numbered_light_names(const Manifest& m) {
  LightNames names;
  std::size_t number = 0;
  for (std::size_t i = 0; i < m.area_lights.size(); ++i)
    names.area_lights.push_back(fmt::format("area-{}", ++number));
  for (const Light& light : m.lights)
    names.lights.push_back(fmt::format("{}-{}", kind_of(light.model), ++number));
  for (const Medium& medium : m.media) {
    const bool shines = medium.emission || medium.temperature;
    names.media.push_back(shines ? fmt::format("medium-{}", names.media.size() + 1) : "");
  }
  return names;
}

LightNames light_names(const Manifest& m) {
  LightNames names = numbered_light_names(m);
  for (std::size_t i = 0; i < m.area_lights.size(); ++i)
    if (!m.area_lights[i].name.empty()) names.area_lights[i] = typed_name(m.area_lights[i].name);
  for (std::size_t i = 0; i < m.lights.size(); ++i)
    if (!m.lights[i].name.empty()) names.lights[i] = typed_name(m.lights[i].name);
  return names;
}

}  // namespace vitrail
