// SPDX-License-Identifier: Apache-2.0
#include "bundle/record_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/system/diagnostics.h"

namespace vitrail {

Json names_to_json(const Manifest& m) {
  Json json = Json::object();
  if (std::ranges::all_of(m.materials, [](const Material& material) { return material.name.empty(); }))
    return json;
  for (const Material& material : m.materials) json["materials"].push_back(material.name);
  return json;
}

void take_names(const Json& json, Manifest& m) {
  const Json& names = json.at("materials");
  if (names.size() != m.materials.size())
    throw Error(fmt::format("the manifest has names of {} materials, but there are {}", names.size(),
                            m.materials.size()));
  for (std::size_t i = 0; i < names.size(); ++i) m.materials[i].name = names[i].get<std::string>();
}

}  // namespace vitrail
