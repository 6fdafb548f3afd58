// SPDX-License-Identifier: Apache-2.0
// pbrt-v4 takes the way of a moving shape apart in the object's space, as is done here, and that of a moving
// instance in the space of its camera. So an instance that turns is elsewhere between its keyframes
// (docs/why/motion.md).
#pragma once

#include <algorithm>

#include "scene/geometry/motion.h"

namespace vitrail::pbrt {

// Returns whether the motion does more than move along a line.
inline bool turns(const Motion& motion) {
  const auto at_origin = [](Transform t) {
    for (std::size_t i = 0; i < 3; ++i) t.m[i][3] = 0;
    return t;
  };
  return std::ranges::any_of(motion.keys(), [&](const Keyframe& key) {
    return at_origin(key.transform) != at_origin(motion.keys().front().transform);
  });
}

inline constexpr const char* turned_by_camera =
    "a moving instance that turns: pbrt turns it about its camera, so that it is elsewhere between the "
    "keyframes; "
    "as here with pbrt's --render-coord-sys world";

}  // namespace vitrail::pbrt
