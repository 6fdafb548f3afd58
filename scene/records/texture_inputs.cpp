// SPDX-License-Identifier: Apache-2.0
#include "scene/records/texture_inputs.h"

#include <algorithm>
#include <set>
#include <vector>

namespace vitrail {

namespace {

bool is_of_attribute(const TextureModel& model) {
  const auto* image = std::get_if<ImageTexture>(&model);
  return std::holds_alternative<MeshAttributeTexture>(model) ||
         (image && std::holds_alternative<AttributeMapping>(image->mapping));
}

}  // namespace

bool reads_attribute(std::span<const Texture> textures, Id<Texture> texture) {
  std::vector<Id<Texture>> open{texture};
  std::set<std::uint32_t> seen;
  while (!open.empty()) {
    const Id<Texture> id = open.back();
    open.pop_back();
    if (!seen.insert(id.value).second) continue;
    if (is_of_attribute(textures[id.value].model)) return true;
    for_texture_inputs(textures[id.value].model, [&](Id<Texture> input) { open.push_back(input); });
  }
  return false;
}

}  // namespace vitrail
