// SPDX-License-Identifier: Apache-2.0
// This file turns light into the numbers that screens take.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "scene/spectra/color.h"

namespace vitrail {

// Encodes by sRGB's transfer function, clamped, rounded to nearest; the greatest Integer is white.
// `out` gets as many as `linear` has.
template <class Integer>
void to_srgb_integers(std::span<const float> linear, Integer* out) {
  constexpr double most = std::numeric_limits<Integer>::max();
  std::transform(linear.begin(), linear.end(), out, [](float value) {
    return static_cast<Integer>(
        std::lround(most * srgb_encode(std::clamp(static_cast<double>(value), 0.0, 1.0))));
  });
}

}  // namespace vitrail
