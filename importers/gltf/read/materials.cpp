// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/materials.h"

#include "importers/gltf/read/material_builder.h"

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

}  // namespace vitrail::gltf
