// SPDX-License-Identifier: Apache-2.0
#include "farm/transport/clock_offset.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace vitrail {

ClockOffset clock_offset(std::span<const Meeting> own, std::span<const Meeting> others) {
  std::int64_t least = std::numeric_limits<std::int64_t>::min(),
               most = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < own.size(); ++i) {
    least = std::max(least, own[i].came_ns - others[i].left_ns);
    most = std::min(most, own[i].left_ns - others[i].came_ns);
  }
  if (least <= 0 && most >= 0) return {0, std::max(-least, most)};
  const std::int64_t middle = least + (most - least) / 2;
  return {middle, most - middle};
}

}  // namespace vitrail
