// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace vitrail {

// Weights of a film whose samples add to several pixels are whole numbers of 2^-weight_bits.
inline constexpr int weight_bits = 16;
inline constexpr int most_splat_pixels = 9;           // of a sample, an axis
inline constexpr double greatest_splat_radius = 4.5;  // of a filter whose samples reach no more than these

// The pixels that a sample adds to: `wide` by `high` of them, of which the first is (x, y) from its own, row
// by row from the top left. Their weights are the filter's values there, ∫f = 1.
struct Footprint {
  int x = 0, y = 0, wide = 0, high = 0;
  std::array<std::int32_t, most_splat_pixels * most_splat_pixels> weights;
};

}  // namespace vitrail
