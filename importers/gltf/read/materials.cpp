// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/materials.h"

#include "importers/gltf/read/material_builder.h"
#include "scene/models/normal_map.h"

namespace vitrail::gltf {

const Surface& Materials::surface(int material, int color_channels, int mesh) {
  const auto [at, is_new] = known_.try_emplace({material, color_channels});
  if (!is_new) return at->second;
  if (material >= 0) {
    const auto& m = document_.element(document_.model().materials, material, "materials", "meshes", mesh);
    single_sided_ += m.doubleSided ? 0 : 1;
  }
  return at->second =
             MaterialBuilder(document_, material, color_channels, scene_, diagnostics_, textures_).build();
}

Id<Material> Materials::turned_over(Id<Material> id) {
  const auto [at, is_new] = turned_over_.try_emplace(id.value, id);
  Material material = scene_.materials.at(id.value);
  if (!is_new || !material.normal_map) return at->second;
  NormalMap map = *normal_map_of(scene_.textures, *material.normal_map);
  map.factors[1] = -map.factors[1];
  scene_.textures.push_back({scaled_normal_map(map), false, "", material.origin});
  material.normal_map = Id<Texture>{static_cast<std::uint32_t>(scene_.textures.size() - 1)};
  scene_.materials.push_back(std::move(material));
  return at->second = {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
}

}  // namespace vitrail::gltf
