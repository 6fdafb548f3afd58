// SPDX-License-Identifier: Apache-2.0
#include "scene/records/texture_inputs.h"

namespace vitrail {

namespace {

bool is_of_attribute(const TextureModel& model) {
  const auto* image = std::get_if<ImageTexture>(&model);
  return std::holds_alternative<MeshAttributeTexture>(model) ||
         (image && std::holds_alternative<AttributeMapping>(image->mapping));
}

}  // namespace

bool reads_attribute(std::span<const Texture> textures, Id<Texture> texture) {
  return leads_to(textures, texture, is_of_attribute,
                  [](const TextureModel& model, auto&& f) { for_texture_inputs(model, f); });
}

}  // namespace vitrail
