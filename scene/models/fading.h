// SPDX-License-Identifier: Apache-2.0
// These functions compute how a lamp weakens with the distance as POV-Ray has it (its documentation, "Light
// Fading").
#pragma once

#include "scene/geometry/portable_math.h"
#include "scene/records/light.h"

namespace vitrail {

// Returns whether the lamp weakens at all.
inline bool weakens(const Fading& fading) { return fading.fade_distance > 0 && fading.fade_power > 0; }

// Returns the irradiance across the direction over the intensity: 2/(1 + (d/fade_distance)^fade_power), or 1.
inline double weakened(const Fading& fading, double distance) {
  if (!weakens(fading)) return 1;
  const double ratio = distance / static_cast<double>(fading.fade_distance);
  const auto power = static_cast<double>(fading.fade_power);
  return 2 / (1 + (power == 2 ? ratio * ratio : portable_pow(ratio, power)));
}

}  // namespace vitrail
