// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

namespace vitrail {

// It is a position between the nodes `first` and `first + 1`, or at `first` where part = 0.
struct Between {
  std::size_t first = 0;
  double part = 0;
};

// Returns the position of x among ascending nodes. Beyond them it is that of the nearest end.
inline Between locate(std::span<const float> nodes, double x) {
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x, [](double value, float node) {
    return value < static_cast<double>(node);
  });
  if (above == nodes.begin()) return {0, 0};
  const auto first = static_cast<std::size_t>(above - nodes.begin()) - 1;
  if (above == nodes.end()) return {first, 0};
  const auto low = static_cast<double>(nodes[first]), high = static_cast<double>(nodes[first + 1]);
  return {first, (x - low) / (high - low)};  // low ≤ x < high
}

}  // namespace vitrail
