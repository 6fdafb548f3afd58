// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/units.h"

#include <cmath>

#include "scene/geometry/bounds.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::povray {

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

Bounds3d bounds_of(const Scene& scene) {
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

}  // namespace

Units units_of(const Scene& scene) {
  Bounds3d bounds = bounds_of(scene);
  const double extent_of_shapes = length(extent(bounds));
  std::visit(
      [&](const auto& camera) {
        extend(bounds, transform_point(camera.camera_to_world, {0, 0, 0}));
      },
      scene.camera);
  for (const Light& light : scene.lights)
    if (const auto* point = std::get_if<PointLight>(&light.model)) extend(bounds, point->position);
  Units units;
  units.center = center(bounds);
  units.radius = length(extent(bounds)) / 2;
  if (!(units.radius > 0) || !std::isfinite(units.radius)) units.radius = 1;
  const double size = extent_of_shapes > 0 ? extent_of_shapes : units.radius;
  constexpr double smallest = 1, largest = 1e5, wanted = 16, far = 64;
  if (size < smallest || size > largest) units.scale = std::exp2(std::round(std::log2(wanted / size)));
  const Vector3d away = units.center - Point3d{};
  const bool is_far = length(away) > far * units.radius;
  if (units.scale != 1 || is_far)
    units.to_pov = scale({units.scale, units.scale, units.scale}) * translate(is_far ? -away : Vector3d{});
  return units;
}

}  // namespace vitrail::povray
