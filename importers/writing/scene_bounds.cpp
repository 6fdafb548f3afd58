// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/scene_bounds.h"

#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

Bounds3d bounds_of(const Scene& scene, const std::vector<Shape>& shapes) {
  Bounds3d bounds;
  for (const Shape& shape : shapes) {
    const Bounds3f own = vitrail::bounds_of(scene.meshes.at(shape.mesh.value));
    if (own.empty()) continue;
    for (int corner = 0; corner < 8; ++corner)
      extend(bounds, transform_point(shape.object_to_world, {corner & 1 ? own.upper.x : own.lower.x,
                                                             corner & 2 ? own.upper.y : own.lower.y,
                                                             corner & 4 ? own.upper.z : own.lower.z}));
  }
  return bounds;
}

}  // namespace

Bounds3d bounds_of_shapes(const Scene& scene) {
  Bounds3d bounds = bounds_of(scene, scene.shapes);
  std::vector<Bounds3d> prototypes;
  for (const Prototype& prototype : scene.prototypes)
    prototypes.push_back(bounds_of(scene, prototype.shapes));
  for (const Instance& instance : scene.instances) {
    const Bounds3d& own = prototypes.at(instance.prototype.value);
    if (own.empty()) continue;
    for (int corner = 0; corner < 8; ++corner)
      extend(bounds, transform_point(instance.prototype_to_world, {corner & 1 ? own.upper.x : own.lower.x,
                                                                   corner & 2 ? own.upper.y : own.lower.y,
                                                                   corner & 4 ? own.upper.z : own.lower.z}));
  }
  return bounds;
}

}  // namespace vitrail
