// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace vitrail {

// Returns the place of pixel (x, y) ≥ 0 in rows of `width`. A picture may have 2³² − 1 pixels, more than an
// int counts.
constexpr std::size_t pixel_place(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

}  // namespace vitrail
