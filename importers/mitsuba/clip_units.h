// SPDX-License-Identifier: Apache-2.0
// Mitsuba's reader and writer convert near and far planes between our camera and Mitsuba's.
#pragma once

#include <cmath>

#include "scene/records/camera.h"

namespace vitrail::mitsuba {

// Returns the length in the world of one along the camera's axis; 1 where it is nearly that.
inline double depth_unit(const Camera& camera) {
  const double unit = std::visit(
      [](const auto& c) {
        return length(transform_vector(c.camera_to_world, {0, 0, 1}));
      },
      camera);
  return std::abs(unit - 1) <= 1e-6 || !(unit > 0) ? 1 : unit;
}

// A perspective camera of Mitsuba 3 has no scale. An orthographic one has `near_clip` in its own space, and
// the two planes are as far apart in the world as they say (3.9.1, measured).
inline ClipRange to_mitsuba(const ClipRange& c, const Camera& camera) {
  const auto unit = static_cast<float>(depth_unit(camera));
  if (unit == 1) return c;
  if (std::holds_alternative<OrthographicCamera>(camera)) return {c.near, c.near + (c.far - c.near) * unit};
  return {c.near * unit, c.far * unit};
}

// Takes a camera as it is read, whose scale is kept.
inline ClipRange from_mitsuba(const ClipRange& c, const Camera& camera) {
  const auto unit = static_cast<float>(depth_unit(camera));
  if (unit == 1 || !std::holds_alternative<OrthographicCamera>(camera)) return c;
  return {c.near, c.near + (c.far - c.near) / unit};
}

}  // namespace vitrail::mitsuba
