// SPDX-License-Identifier: Apache-2.0
#include "scene/nesting.h"

#include <algorithm>

namespace vitrail {

bool has_nested_instances(const Scene& scene) {
  return std::ranges::any_of(scene.prototypes, [](const Prototype& p) { return !p.instances.empty(); });
}

Scene without_nested_instances(const Scene& scene) {
  Scene flat = scene;
  // Prototypes have instances of earlier ones only, which are flat by then.
  for (Prototype& prototype : flat.prototypes) {
    for (const Instance& instance : prototype.instances)
      for (Shape shape : flat.prototypes.at(instance.prototype.value).shapes) {
        shape.object_to_world = instance.prototype_to_world * shape.object_to_world;
        // A mirrored instance keeps the fronts of its prototype.
        if (swaps_handedness(instance.prototype_to_world)) shape.flip_orientation = !shape.flip_orientation;
        prototype.shapes.push_back(std::move(shape));
      }
    prototype.instances.clear();
  }
  return flat;
}

}  // namespace vitrail
