// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/units.h"

#include <cmath>

#include "importers/writing/scene_bounds.h"

namespace vitrail::povray {

Units units_of(const Scene& scene) {
  Bounds3d bounds = bounds_of_shapes(scene);
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
