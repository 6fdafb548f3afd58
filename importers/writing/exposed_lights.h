// SPDX-License-Identifier: Apache-2.0
// Some formats have a film without exposure. ExposedLights has every light times the imaging ratio of the
// scene's film, which gives the same picture.
#pragma once

#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

struct ExposedLights {
  explicit ExposedLights(const Scene& scene);

  std::vector<Light> lights;
  std::vector<AreaLight> area_lights;
};

}  // namespace vitrail
