// SPDX-License-Identifier: Apache-2.0
#include "bundle/kept_glazing.h"

#include <fmt/format.h>

#include "bundle/checked_json.h"
#include "bundle/manifest.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

constexpr int glazing_version = 1;

}  // namespace

std::filesystem::path glazing_path(const std::filesystem::path& bundle) { return bundle / "glazing.json"; }

void write_glazings(const std::filesystem::path& bundle, std::uint64_t scene_hash,
                    const std::vector<KeptGlazing>& glazings) {
  if (glazings.empty()) return;
  Json systems = Json::array();
  for (const KeptGlazing& glazing : glazings) {
    Json sheets = Json::array();
    for (const auto& [front, back] : glazing.sheets) sheets.push_back({front, back});
    systems.push_back({{"name", glazing.name}, {"sheets", sheets}, {"system", glazing.system}});
  }
  write_checked_json(glazing_path(bundle), {{"format", "vitrail glazing"},
                                            {"version", glazing_version},
                                            {"scene_hash", fmt::format("{:016x}", scene_hash)},
                                            {"systems", systems}});
}

std::vector<KeptGlazing> read_glazings(const std::filesystem::path& bundle, const Manifest& manifest) {
  const std::filesystem::path file = glazing_path(bundle);
  const auto require = [&](bool condition, const char* what) {
    if (!condition) throw Error(what, {file.string()});
  };
  if (!std::filesystem::exists(file)) {
    require(manifest.switching_glazings == 0,
            "it is lost: the bundle has switchable glazing; partition the scene again");
    return {};
  }
  const Json json = read_checked_json(file, "the glazing");
  try {
    require(json.at("format") == "vitrail glazing", "not the glazing of a bundle");
    require(json.at("version") == glazing_version, "glazing of a version that this program does not read");
    require(json.at("scene_hash") == fmt::format("{:016x}", manifest.scene_hash),
            "this file belongs to another bundle; partition the scene again");
    std::vector<KeptGlazing> glazings;
    for (const Json& system : json.at("systems")) {
      KeptGlazing& glazing = glazings.emplace_back();
      glazing.name = system.at("name").get<std::string>();
      glazing.system = system.at("system").get<std::string>();
      for (const Json& sheet : system.at("sheets")) {
        glazing.sheets.push_back({sheet.at(0).get<std::uint32_t>(), sheet.at(1).get<std::uint32_t>()});
        const auto& [front, back] = glazing.sheets.back();
        require(front < manifest.materials.size() && back < manifest.materials.size(),
                "the glazing refers to a material that is not there");
      }
      require(!glazing.sheets.empty(), "a glazing has no surface");
    }
    return glazings;
  } catch (const Json::exception& e) {
    throw Error(fmt::format("the glazing is not as it should be: {}", e.what()), {file.string()});
  }
}

}  // namespace vitrail
