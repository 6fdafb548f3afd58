// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>

#include "importers/pbrt/textures.h"
#include "scene/scene.h"

namespace vitrail::pbrt {

// The name of the material that stands for another one.
struct MaterialAlias {
  std::string name;
  Place place;
};

// The material of v3's or v4's kind `kind`. Kinds that are not diffuse, smooth dielectric or interface become
// the nearest of these, and the report says how.
std::variant<Material, MaterialAlias> make_material(const std::string& kind, ParameterSet& parameters,
                                                    const Scope& scope);

}  // namespace vitrail::pbrt
