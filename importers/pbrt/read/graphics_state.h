// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "importers/pbrt/read/lights.h"
#include "importers/pbrt/read/parameters.h"
#include "scene/records/scene.h"

namespace vitrail::pbrt {

// It is an AreaLightSource; the record of the scene is made for the first shape that has it.
struct AreaLightState {
  AreaEmission emission;
  std::optional<Id<AreaLight>> id;
};

// A GraphicsState holds what AttributeBegin saves and AttributeEnd restores.
struct GraphicsState {
  Transform ctm, ctm_end;                             // at the two TransformTimes
  bool transform_start = true, transform_end = true;  // which of them change: ActiveTransform
  bool reverse_orientation = false;
  std::optional<Id<Material>> material;  // none: pbrt's default, diffuse 0.5
  std::optional<Id<Medium>> interior, exterior;
  std::shared_ptr<AreaLightState> area_light;
  std::string color_space = "srgb";
  // They are defaults that Attribute sets for the parameters of "shape", "light", "material", "medium" and
  // "texture".
  std::shared_ptr<const std::map<std::string, std::vector<Parameter>>> defaults;
};

}  // namespace vitrail::pbrt
