// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// Returns the weight a²/(a² + b²) of a sample that was drawn with density a = `chosen` > 0, where another way
// has the density b = `other` there (Veach 1997, eq. 9.13).
inline double power_heuristic(double chosen, double other) {
  const double ratio = other / chosen;
  return 1 / (1 + ratio * ratio);
}

}  // namespace vitrail
