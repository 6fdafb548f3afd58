// SPDX-License-Identifier: Apache-2.0
// Mitsuba's reader and writer compute the window that a perspective camera shows in one order of operations:
// what one writes the other reads to the bit.
#pragma once

#include <cmath>
#include <numbers>

#include "scene/records/camera.h"

namespace vitrail::mitsuba {

// It is half of the screen's width and height in the plane z = 1.
struct HalfScreen {
  double x = 1, y = 1;
};

// tan 45° is 1, as pbrt's reader has it.
inline double tan_half(double fov_deg) {
  return fov_deg == 90 ? 1 : std::tan(fov_deg / 2 * std::numbers::pi / 180);
}

// `aspect` is width / height; pixels are square.
inline HalfScreen half_screen_of_width(double x, double aspect) { return {x, 1 / aspect * x}; }
inline HalfScreen half_screen_of_height(double y, double aspect) { return {aspect * y, y}; }

// The offset of the principal point is in parts of the picture's width and height, downwards positive.
inline ScreenWindow screen_window(const HalfScreen& half, double offset_x, double offset_y) {
  const double x = offset_x * 2 * half.x, y = -offset_y * 2 * half.y;
  return {x - half.x, x + half.x, y - half.y, y + half.y};
}

}  // namespace vitrail::mitsuba
