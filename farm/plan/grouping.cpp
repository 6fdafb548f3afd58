// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/grouping.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "bundle/checksum.h"
#include "bundle/light_names.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// With * for any characters.
bool matches(std::string_view pattern, std::string_view name) {
  const std::size_t star = pattern.find('*');
  if (star == pattern.npos) return pattern == name;
  if (name.substr(0, star) != pattern.substr(0, star)) return false;
  name.remove_prefix(star);
  pattern.remove_prefix(star + 1);
  for (;; name.remove_prefix(1)) {
    if (matches(pattern, name)) return true;
    if (name.empty()) return false;
  }
}

std::string list_of(const LightNames& names) {
  constexpr std::size_t most = 20;
  std::set<std::string> all;
  for (const auto* list : {&names.area_lights, &names.lights, &names.media})
    all.insert(list->begin(), list->end());
  all.erase("");
  std::vector<std::string> shown(all.begin(), all.end());
  const std::size_t more = shown.size() - std::min(shown.size(), most);
  shown.resize(shown.size() - more);
  if (more > 0) shown.push_back(fmt::format("{} more", more));
  return shown.empty() ? "none" : fmt::format("{}", fmt::join(shown, ", "));
}

// Numbers the groups as lights come that are in them, in the order in which they are asked for.
class Numbering {
 public:
  explicit Numbering(const LightGrouping& asked) : asked_(asked), used_(asked.groups.size()) {
    for (const LightGrouping::Group& g : asked.groups) names_.push_back(g.name);
  }

  std::uint8_t of(const std::string& light) {
    const LightGrouping::Group* in = nullptr;
    for (const LightGrouping::Group& g : asked_.groups)
      if (std::ranges::any_of(g.lights,
                              [&](const std::string& pattern) { return matches(pattern, light); })) {
        if (in)
          throw UsageError(fmt::format("--light-group: {} is in {} and in {}", light, in->name, g.name));
        in = &g;
      }
    if (in) used_[static_cast<std::size_t>(in - asked_.groups.data())] = true;
    return number_of(in ? in->name : asked_.each ? light : "others");
  }

  std::vector<std::string> finished(const LightNames& names) {
    for (std::size_t i = 0; i < used_.size(); ++i)
      if (!used_[i])
        throw UsageError(fmt::format("--light-group {}: no light has such a name; there is {}",
                                     asked_.groups[i].name, list_of(names)));
    return std::move(names_);
  }

 private:
  std::uint8_t number_of(const std::string& name) {
    const auto known = std::ranges::find(names_, name);
    if (known != names_.end()) return static_cast<std::uint8_t>(known - names_.begin());
    if (names_.size() == most_light_groups)
      throw UsageError(
          fmt::format("--light-groups: a film keeps at most {} groups apart, and the scene has "
                      "more lights: name them in groups with --light-group NAME=LIGHTS",
                      most_light_groups));
    names_.push_back(name);
    return static_cast<std::uint8_t>(names_.size() - 1);
  }

  const LightGrouping& asked_;
  std::vector<std::string> names_;
  std::vector<bool> used_;
};

bool is_all_around(const Light& light) {
  return std::holds_alternative<InfiniteLight>(light.model) ||
         std::holds_alternative<EnvironmentLight>(light.model) ||
         std::holds_alternative<SkyLight>(light.model);
}

std::uint8_t surroundings_of(const Manifest& m, const std::vector<std::uint8_t>& groups) {
  std::set<std::uint8_t> around;
  for (std::size_t i = 0; i < m.lights.size(); ++i)
    if (is_all_around(m.lights[i])) around.insert(groups[i]);
  return around.empty()       ? std::uint8_t{0}
         : around.size() == 1 ? *around.begin()
                              : GroupedLights::by_direction;
}

}  // namespace

LightGrouping::Group parse_light_group(const std::string& text) {
  const std::size_t equals = text.find('=');
  LightGrouping::Group group{text.substr(0, equals), {}};
  if (equals != text.npos) {
    std::istringstream list(text.substr(equals + 1));
    for (std::string light; std::getline(list, light, ',');) group.lights.push_back(light);
  }
  const bool is_plain = std::ranges::none_of(
      group.name, [](unsigned char c) { return c <= ' ' || c == 0x7f || c == ',' || c == '*'; });
  constexpr std::size_t most_bytes = 64;
  if (group.lights.empty() || group.name.empty() || group.name.size() > most_bytes || !is_plain)
    throw UsageError("--light-group takes NAME=LIGHT,LIGHT…, as in lamps=area-1,spot-*: " + text);
  return group;
}

Grouping group_lights(const LightGrouping& asked, const Manifest& m) {
  Grouping grouping;
  if (!asked.any()) return grouping;
  const LightNames names = light_names(m);
  Numbering numbering(asked);
  GroupedLights& table = grouping.table;
  table.kept_apart = true;
  for (const std::string& name : names.area_lights) table.area_lights.push_back(numbering.of(name));
  for (const std::string& name : names.lights) table.lights.push_back(numbering.of(name));
  for (const std::string& name : names.media)
    table.media.push_back(name.empty() ? std::uint8_t{0} : numbering.of(name));
  table.surroundings = surroundings_of(m, table.lights);
  grouping.groups.names = numbering.finished(names);
  if (!grouping.groups.any()) throw UsageError("--light-groups: the scene has no light");
  Hasher hasher;
  for (const auto* list : {&table.area_lights, &table.lights, &table.media})
    hasher.add(std::as_bytes(std::span(*list)));
  grouping.groups.lights = hasher.digest();
  return grouping;
}

}  // namespace vitrail
