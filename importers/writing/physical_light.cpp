// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/physical_light.h"

#include <fmt/format.h>

#include "importers/writing/scene_bounds.h"
#include "scene/models/fading.h"

namespace vitrail {

PhysicalLight physical_light(const Scene& scene, const std::optional<Fading>& fading, Point3d position) {
  if (!fading) return {};
  const Bounds3d bounds = bounds_of_shapes(scene);
  const double radius = bounds.empty() ? 1 : length(extent(bounds)) / 2;
  double middle = bounds.empty() ? 1 : length(center(bounds) - position);
  if (!(middle > 0)) middle = radius > 0 ? radius : 1;
  PhysicalLight light;
  light.factor = weakened(*fading, middle) * (middle * middle);
  const auto too_bright = [&](double distance) {
    return light.factor / (distance * distance) / weakened(*fading, distance);
  };
  light.note = fmt::format(
      "it weakens as 1/d² and not as POV-Ray's: as bright at the middle of the scene, {:.2g} times at its "
      "far "
      "end, ",
      too_bright(middle + radius));
  light.note += middle > radius ? fmt::format("{:.2g} times at its near end", too_bright(middle - radius))
                                : "and more without bound where the light is near";
  return light;
}

}  // namespace vitrail
