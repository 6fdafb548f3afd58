// SPDX-License-Identifier: Apache-2.0
#include "bundle/light_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/records/kinds.h"

namespace vitrail {

namespace {

constexpr std::size_t most_bytes = 64;

std::string usable(std::string name) {
  name.resize(std::min(name.size(), most_bytes));
  std::ranges::replace_if(
      name, [](unsigned char c) { return c <= ' ' || c == 0x7f || c == ',' || c == '='; }, '_');
  return name;
}

std::string name_of(const std::string& given, const char* kind, std::size_t number) {
  return given.empty() ? fmt::format("{}-{}", kind, number) : usable(given);
}

}  // namespace

LightNames light_names(const Manifest& m) {
  LightNames names;
  std::size_t number = 0;
  for (const AreaLight& light : m.area_lights)
    names.area_lights.push_back(name_of(light.name, "area", ++number));
  for (const Light& light : m.lights)
    names.lights.push_back(name_of(light.name, kind_of(light.model), ++number));
  for (const Medium& medium : m.media) {
    const bool shines = medium.emission || medium.temperature;
    names.media.push_back(shines ? fmt::format("medium-{}", names.media.size() + 1) : "");
  }
  return names;
}

}  // namespace vitrail
