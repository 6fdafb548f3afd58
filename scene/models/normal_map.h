// SPDX-License-Identifier: Apache-2.0
// These functions handle normal maps whose components have factors.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/records/texture.h"

namespace vitrail {

// It is an image as a normal map: its (rgb·2 − 1) times the factors.
struct NormalMap {
  Id<Texture> image;
  std::array<float, 3> factors{1, 1, 1};
};

// A normal map with factors is a ProductTexture of the factors and an image. The factors stand as the numbers
// of a colour, and may be negative: (1, −1, 1) turns a map over, (2, 2, 1) makes it twice as steep.
inline ProductTexture scaled_normal_map(const NormalMap& map) {
  return {Spectrum{RgbUnboundedSpectrum{{}, 1, map.factors}}, map.image};
}

// Returns the image and the factors of a material's normal map; nothing where it is neither an image nor such
// a product.
inline std::optional<NormalMap> normal_map_of(const std::vector<Texture>& textures, Id<Texture> map) {
  const auto is_image = [&](Id<Texture> id) {
    return std::holds_alternative<ImageTexture>(textures.at(id.value).model);
  };
  if (is_image(map)) return NormalMap{map};
  const auto* product = std::get_if<ProductTexture>(&textures.at(map.value).model);
  const auto* image = product ? std::get_if<Id<Texture>>(&product->second) : nullptr;
  const auto* first = product ? std::get_if<Spectrum>(&product->first) : nullptr;
  const auto* factors = first ? std::get_if<RgbUnboundedSpectrum>(first) : nullptr;
  if (!image || !factors || !is_image(*image)) return {};
  return NormalMap{*image, factors->rgb};
}

}  // namespace vitrail
