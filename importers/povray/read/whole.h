// SPDX-License-Identifier: Apache-2.0
// Whole numbers of numbers that a scene states, however large.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vitrail::pov {

// x without its fraction, at most 9·10¹⁸ either way, 0 if it is not a number: a cast of more is undefined.
inline std::int64_t whole(double x) {
  return std::isnan(x) ? 0 : static_cast<std::int64_t>(std::clamp(x, -9e18, 9e18));
}

// The same, held to a range.
inline int whole(double x, int least, int most) {
  return static_cast<int>(std::clamp<std::int64_t>(whole(x), least, most));
}

}  // namespace vitrail::pov
