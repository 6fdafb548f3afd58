// SPDX-License-Identifier: Apache-2.0
// These functions go through the inputs that a texture's value is made of.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <variant>
#include <vector>

#include "scene/records/fields.h"

namespace vitrail {

// Calls f(parameter) for the inputs of a texture.
template <class F>
void for_inputs(const TextureModel& model, F&& f) {
  const auto pass_on = [&]<class Field>(const Field& field) {
    if constexpr (IsOneOf<Field, FloatParameter, SpectrumParameter>) f(field);
    if constexpr (Is<Field, std::vector<PatternStop>>)
      for (const PatternStop& stop : field) f(stop.value);
  };
  std::visit([&](const auto& m) { visit_fields(m, [&](const auto&... field) { (pass_on(field), ...); }); },
             model);
}

// Calls f(id) for those inputs that are textures.
template <class F>
void for_texture_inputs(const TextureModel& model, F&& f) {
  for_inputs(model, [&](const auto& parameter) {
    if (const auto* id = std::get_if<Id<Texture>>(&parameter)) f(*id);
  });
}

// Returns whether is_wanted(model) holds of the texture or of one that it leads to. for_next(model, f) calls
// f(id) with the inputs of a texture that count.
template <class IsWanted, class ForNext>
bool leads_to(std::span<const Texture> textures, Id<Texture> texture, IsWanted&& is_wanted,
              ForNext&& for_next) {
  std::vector<Id<Texture>> open{texture};
  std::set<std::uint32_t> seen;
  while (!open.empty()) {
    const Id<Texture> id = open.back();
    open.pop_back();
    if (!seen.insert(id.value).second) continue;
    const TextureModel& model = textures[id.value].model;
    if (is_wanted(model)) return true;
    for_next(model, [&](Id<Texture> input) { open.push_back(input); });
  }
  return false;
}

// Returns whether some attribute of a mesh counts in the texture's or parameter's value.
bool reads_attribute(std::span<const Texture> textures, Id<Texture> texture);
template <class Parameter>
bool reads_attribute(std::span<const Texture> textures, const Parameter& parameter) {
  const auto* id = std::get_if<Id<Texture>>(&parameter);
  return id && reads_attribute(textures, *id);
}

}  // namespace vitrail
