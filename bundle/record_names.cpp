// SPDX-License-Identifier: Apache-2.0
#include "bundle/record_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Calls visit(key, records) for each list of records that have names.
template <class ManifestType, class Visit>
void each_list(ManifestType& m, Visit&& visit) {
  visit("materials", m.materials);
  visit("area_lights", m.area_lights);
  visit("lights", m.lights);
}

}  // namespace

Json names_to_json(const Manifest& manifest) {
  Json json = Json::object();
  each_list(manifest, [&](const char* key, const auto& records) {
    if (std::ranges::all_of(records, [](const auto& record) { return record.name.empty(); })) return;
    for (const auto& record : records) json[key].push_back(record.name);
  });
  return json;
}

void take_names(const Json& json, Manifest& manifest) {
  each_list(manifest, [&](const char* key, auto& records) {
    if (!json.contains(key)) return;
    const Json& names = json.at(key);
    if (names.size() != records.size())
      throw Error(fmt::format("the manifest has names of {} {}, but there are {}", names.size(), key,
                              records.size()));
    for (std::size_t i = 0; i < records.size(); ++i) records[i].name = names[i].template get<std::string>();
  });
}

}  // namespace vitrail
