// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace vitrail {

// Weights of a film whose samples add to several pixels are whole numbers of 2^-weight_bits.
inline constexpr int weight_bits = 16;
inline constexpr int most_splat_pixels = 9;           // of a sample, an axis
inline constexpr double greatest_splat_radius = 4.5;  // of a filter whose samples reach no more than these

// A Footprint is the pixels that a sample adds to: `wide` by `high` of them, row by row from the top left.
// The first is (x, y) from the sample's own. Their weights are the filter's values there, ∫f = 1.
struct Footprint {
  int x = 0, y = 0, wide = 0, high = 0;
  std::array<std::int32_t, std::size_t{most_splat_pixels} * most_splat_pixels> weights;
};

// Calls visit(pixel, weight) for the pixels inside width × height that a sample of `pixel` adds to.
template <class Visit>
void for_each_pixel(const Footprint& of, std::uint32_t pixel, int width, int height, Visit&& visit) {
  const auto across = static_cast<std::uint32_t>(width);
  const int x0 = static_cast<int>(pixel % across) + of.x, y0 = static_cast<int>(pixel / across) + of.y;
  const int first = std::max(0, -x0), end = std::min(of.wide, width - x0);
  for (int j = std::max(0, -y0); j < std::min(of.high, height - y0); ++j)
    for (int i = first; i < end; ++i)
      if (const std::int32_t w = of.weights[static_cast<std::size_t>(j * of.wide + i)]; w != 0)
        visit(static_cast<std::size_t>(y0 + j) * across + static_cast<std::size_t>(x0 + i), w);
}

}  // namespace vitrail
