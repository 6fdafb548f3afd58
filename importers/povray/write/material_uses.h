// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/records/scene.h"

namespace vitrail::povray {

// Returns the material and all that it is made of, those with smaller ids first, each once.
std::vector<Id<Material>> parts_of(const Scene& scene, Id<Material> material);

// It says which light of lamps the material, or one that it is made of, throws on as a caustic.
struct Caustics {
  bool reflected = false, refracted = false;
};
Caustics caustics_of(const Scene& scene, Id<Material> material);

// Returns the textures that a material refers to itself.
std::vector<Id<Texture>> textures_of(const Material& material);

}  // namespace vitrail::povray
