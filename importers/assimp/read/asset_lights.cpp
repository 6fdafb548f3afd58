// SPDX-License-Identifier: Apache-2.0
#include "importers/assimp/read/asset_lights.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace vitrail::assimp {

LightScale scale_of_light(const AssetLight& light, std::optional<double> units_of_blender) {
  using std::numbers::pi;
  constexpr double never = std::numeric_limits<double>::infinity();
  const bool is_far = light.kind == AssetLight::Kind::directional;
  if (units_of_blender) {
    const double units = *units_of_blender;
    return {is_far ? 1.0 : units * units / (4 * pi * pi), std::nullopt};
  }
  if (is_far) return {pi, std::nullopt};
  if (!(light.constant > 0) && light.quadratic > 0) return {pi / light.quadratic, std::nullopt};
  const double c = light.constant > 0 ? light.constant : 1;
  const double by_linear = light.linear > 0 ? c / light.linear : never,
               by_quadratic = light.quadratic > 0 ? std::sqrt(c / light.quadratic) : never;
  const double half = std::min(by_linear, by_quadratic);
  if (half == never) return {pi / c, Fading{}};
  return {pi / (2 * c), Fading{static_cast<float>(half), by_linear < by_quadratic ? 1.0f : 2.0f}};
}

}  // namespace vitrail::assimp
