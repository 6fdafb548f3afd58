// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "importers/assimp/asset.h"
#include "scene/records/light.h"

namespace vitrail::assimp {

// A light's colour is multiplied by `factor`; `fading` says how it weakens.
struct LightScale {
  double factor = 1;
  std::optional<Fading> fading;  // none: as 1/d², or a light that is far
};

// Without units a light of colour 1 shows white as 1, divided by its attenuation: intensity π/(q·d²) where
// that alone is given, and π/(c + l·d) or π/(c + q·d²), which POV-Ray's fading has, else; of both l and q the
// one counts that halves the light sooner. In Blender's units (a metre has `units_of_blender` of the file's)
// a lamp of P watts has P/(4π²) W/sr, as Cycles shows it, and a sun's colour is its irradiance.
LightScale scale_of_light(const AssetLight& light, std::optional<double> units_of_blender);

}  // namespace vitrail::assimp
