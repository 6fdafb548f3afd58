// SPDX-License-Identifier: Apache-2.0
// A scene states numbers, however large; these functions make whole numbers of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vitrail::pov {

// Returns x without its fraction, at most 9·10¹⁸ either way, 0 for NaN: a cast of more is undefined.
inline std::int64_t whole(double x) {
  return std::isnan(x) ? 0 : static_cast<std::int64_t>(std::clamp(x, -9e18, 9e18));
}

// Returns the same, held to a range.
inline int whole(double x, int least, int most) {
  return static_cast<int>(std::clamp<std::int64_t>(whole(x), least, most));
}

}  // namespace vitrail::pov
