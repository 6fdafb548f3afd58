// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// The weight of a sample that was drawn with density `chosen` > 0, where another way has the density `other`
// there: a²/(a² + b²) (Veach 1997, eq. 9.13).
inline double power_heuristic(double chosen, double other) {
  const double ratio = other / chosen;
  return 1 / (1 + ratio * ratio);
}

}  // namespace vitrail
