// SPDX-License-Identifier: Apache-2.0
// The materials of a bundle.
#pragma once

#include <string>
#include <vector>

#include "partitioner/appearance/bake_textures.h"
#include "scene/scene.h"

namespace vitrail {

// A material made ready for rendering, what stands for something else in it, and the medium that fills it
// where its model brings one (subsurface scattering).
struct BakedMaterial {
  Material material;
  std::vector<std::string> notes;
  std::optional<Medium> interior;
};

// `ids[i]` is the new id of the scene's material i; those that `material` refers to have one.
BakedMaterial bake_material(const Material& material, const std::vector<std::int32_t>& ids,
                            TextureBaker& textures);

// The materials that it refers to.
std::vector<Id<Material>> parts_of(const Material& material);

}  // namespace vitrail
