// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

#include "scene/records/texture.h"

namespace vitrail {

// It is a number or a texture as a key of maps.
using OpacityKey = std::pair<std::uint32_t, float>;

inline OpacityKey opacity_key(const FloatParameter& opacity) {
  constexpr std::uint32_t no_texture = 0xffffffffu;
  if (const auto* constant = std::get_if<float>(&opacity)) return {no_texture, *constant};
  return {std::get<Id<Texture>>(opacity).value, 0};
}

}  // namespace vitrail
