// SPDX-License-Identifier: Apache-2.0
// What a texture's value is made of.
#pragma once

#include <span>
#include <variant>

#include "scene/records/fields.h"

namespace vitrail {

// Calls f(parameter) for the inputs of a texture.
template <class F>
void for_inputs(const TextureModel& model, F&& f) {
  const auto pass_on = [&]<class Field>(const Field& field) {
    if constexpr (IsOneOf<Field, FloatParameter, SpectrumParameter>) f(field);
  };
  std::visit([&](const auto& m) { visit_fields(m, [&](const auto&... field) { (pass_on(field), ...); }); },
             model);
}

// Calls f(id) for those that are textures.
template <class F>
void for_texture_inputs(const TextureModel& model, F&& f) {
  for_inputs(model, [&](const auto& parameter) {
    if (const auto* id = std::get_if<Id<Texture>>(&parameter)) f(*id);
  });
}

// Whether some attribute of a mesh counts in the texture's or parameter's value.
bool reads_attribute(std::span<const Texture> textures, Id<Texture> texture);
template <class Parameter>
bool reads_attribute(std::span<const Texture> textures, const Parameter& parameter) {
  const auto* id = std::get_if<Id<Texture>>(&parameter);
  return id && reads_attribute(textures, *id);
}

}  // namespace vitrail
