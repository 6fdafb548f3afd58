// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/unseen_lamps.h"

#include <algorithm>

#include "scene/records/light_traits.h"

namespace vitrail {

bool hides_emitters(const Scene& scene) {
  if (scene.settings.hides_emitters) return true;
  bool unseen = false,
       seen = std::ranges::any_of(scene.lights, [](const Light&l) { return traits_of(l.model).surrounds; });
  const auto look_at = [&](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes)
      if (shape.area_light) (shape.opacity == FloatParameter{0.0f} ? unseen : seen) = true;
  };
  look_at(scene.shapes);
  for (const Prototype& prototype : scene.prototypes) look_at(prototype.shapes);
  return unseen && !seen;
}

}  // namespace vitrail
