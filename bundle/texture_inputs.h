// SPDX-License-Identifier: Apache-2.0
// What a texture's value is made of.
#pragma once

#include <span>
#include <variant>

#include "scene/texture.h"

namespace vitrail {

// Calls f(parameter) for the inputs of a texture.
template <class F>
void for_inputs(const TextureModel& model, F&& f) {
  std::visit(
      [&](const auto& m) {
        if constexpr (requires { m.even; }) f(m.even), f(m.odd);
        if constexpr (requires { m.first; }) f(m.first), f(m.second);
        if constexpr (requires { m.amount; }) f(m.amount);
        if constexpr (requires { m.inside; }) f(m.inside), f(m.outside);
        if constexpr (requires { m.v00; }) f(m.v00), f(m.v01), f(m.v10), f(m.v11);
      },
      model);
}

// Whether some attribute of a mesh counts in the parameter's value.
template <class Parameter>
bool reads_attribute(std::span<const Texture> textures, const Parameter& parameter) {
  const auto* id = std::get_if<Id<Texture>>(&parameter);
  if (!id) return false;
  const TextureModel& model = textures[id->value].model;
  const auto* image = std::get_if<ImageTexture>(&model);
  bool reads = std::holds_alternative<MeshAttributeTexture>(model) ||
               (image && std::holds_alternative<AttributeMapping>(image->mapping));
  for_inputs(model, [&](const auto& input) { reads = reads || reads_attribute(textures, input); });
  return reads;
}

}  // namespace vitrail
