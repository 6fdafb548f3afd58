// SPDX-License-Identifier: Apache-2.0
// What the renderer shows of a scene: its materials, lights, textures and camera in the terms of
// bundle/appearance.h.
#pragma once

#include <vector>

#include "bundle/appearance.h"
#include "scene/scene.h"

namespace vitrail {

struct Appearance {
  std::vector<bundle::Material> materials;     // one a material of the scene
  std::vector<bundle::AreaLight> area_lights;  // one an area light of the scene
  std::vector<bundle::Light> lights;           // one a light of the scene
  bundle::Camera camera;
  Diagnostics diagnostics;  // what stands for something else, and what is left out; about what is in use only
};

// Models that the renderer does not have become the nearest of those it has; textures become their mean.
Appearance appearance_of(const Scene& scene);

}  // namespace vitrail
