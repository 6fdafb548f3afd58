// SPDX-License-Identifier: Apache-2.0
// This file finds area lights that shine as a rectangle does.
#pragma once

#include <array>
#include <optional>

#include "importers/povray/read/object.h"

namespace vitrail::pov {

// It is a rectangle, or parallelogram, of a diffuse lamp that shines to one side.
struct AreaLamp {
  std::array<Point3d, 4> corners;  // counter-clockwise, as the side that shines is seen
  // They are for each channel as the scene gives it: colour · factor, W·m⁻²·sr⁻¹·nm⁻¹.
  std::array<double, 3> color;
  double factor = 0;
  Place place{};
};

// Returns the lamp that an `area_light` with `area_illumination` is, if its lights are spotlights of `radius
// 90 falloff 90 tightness 1` across the area that fade with the square of the distance. Each of them then
// lights a point at the distance d by c/n · 2f²/d² · cos θ, f being its fade_distance, far below d. Together
// they are a lamp of the radiance 2π·c·f²/A. Returns nothing for another kind of light.
std::optional<AreaLamp> area_lamp(const LightShape& light, const Transform& to_world);

}  // namespace vitrail::pov
