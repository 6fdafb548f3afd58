// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "importers/pbrt/read/textures.h"
#include "scene/records/scene.h"

namespace vitrail::pbrt {

// Materials refer to each other by these functions before all of them have ids.
struct MaterialSlots {
  std::function<Id<Material>(const std::string& name)>
      named;                                  // of a material of that name, defined or to come
  std::function<Id<Material>(Material)> add;  // of one more material
};

// Makes the material of v3's or v4's kind `kind`. v3's become v4's models, or blends of them; what they
// cannot keep is reported. An unknown kind is diffuse.
Material make_material(const std::string& kind, ParameterSet& parameters, const Scope& scope,
                       const MaterialSlots& slots);

}  // namespace vitrail::pbrt
