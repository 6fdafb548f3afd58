// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace vitrail {

// Returns where an integral from `low` on reaches `target`, by Newton's steps, or by halving where they leave
// the bracket. The integral is below the target at `low` and above it at `high`; value(x) gives {integral,
// density}.
template <class Value>
double invert(const Value& value, double low, double high, double target) {
  double x = 0.5 * (low + high);
  for (int step = 0; step < 100; ++step) {
    const auto [integral, density] = value(x);
    (integral < target ? low : high) = x;
    const double next = x - (integral - target) / density;
    const double wanted = next > low && next < high ? next : 0.5 * (low + high);
    if (std::abs(wanted - x) <= 1e-14 * (std::abs(x) + high - low)) return wanted;
    x = wanted;
  }
  return x;
}

}  // namespace vitrail
