// SPDX-License-Identifier: Apache-2.0
#include "cli/develop/chosen_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::string_view group_prefix = "Light.";

bool is_of(const PictureChannel& channel, Layer layer) {
  const LayerKind& kind = kind_of(layer);
  if (kind.is_matte) return channel.name.starts_with(kind.channels[0]);
  return std::ranges::any_of(kind.channels, [&](const char* name) { return name && channel.name == name; });
}

bool is_chosen(const PictureChannel& channel, const ChosenLayers& chosen) {
  if (channel.name.starts_with(group_prefix)) return chosen.groups;
  for (std::size_t i = 0; i < layer_count; ++i)
    if (const auto layer = static_cast<Layer>(i); chosen.layers.has(layer) && is_of(channel, layer))
      return true;
  return false;
}

}  // namespace

ChosenLayers parse_chosen_layers(const std::string& names) {
  ChosenLayers chosen;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    if (name == "all")
      chosen.all = true;
    else if (name == "variance")
      chosen.variance = true;
    else if (name == "spectrum")
      chosen.spectrum = true;
    else if (name == "groups")
      chosen.groups = true;
    else if (!add_named(chosen.layers, name))
      throw UsageError(fmt::format("--layers: \"{}\" is none of all, variance, spectrum, groups, {}, normal",
                                   name, names_of({all_layers})));
  }
  return chosen;
}

void keep_layers(Picture& picture, const ChosenLayers& chosen, const std::string& file) {
  if (chosen.all) return;
  const auto require = [&](bool there, const std::string& name, const char* option) {
    if (!there) throw Error(fmt::format("there is no layer {}: render with {}", name, option), {file});
  };
  const auto has = [&](const auto& is) { return std::ranges::any_of(picture.layers, is); };
  require(!chosen.variance || picture.variance.pixels() > 0, "variance", "two sequences, not --one-sequence");
  require(!chosen.spectrum || picture.spectrum.pixels() > 0, "spectrum", "--spectral N");
  require(!chosen.groups || has([](const auto& c) { return c.name.starts_with(group_prefix); }), "groups",
          "--light-groups");
  for (std::size_t i = 0; i < layer_count; ++i)
    if (const auto layer = static_cast<Layer>(i); chosen.layers.has(layer))
      require(has([&](const auto& c) { return is_of(c, layer); }), kind_of(layer).name, "--aov");
  if (!chosen.variance) picture.variance = {};
  if (!chosen.spectrum) picture.spectrum = {};
  std::erase_if(picture.layers, [&](const auto& channel) { return !is_chosen(channel, chosen); });
  std::erase_if(picture.mattes, [&](const auto& mattes) {
    return !has([&](const auto& channel) { return channel.name.starts_with(mattes.layer); });
  });
}

}  // namespace vitrail
