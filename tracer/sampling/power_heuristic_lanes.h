// SPDX-License-Identifier: Apache-2.0
// This file has power_heuristic.h, for any number of lanes.
#pragma once

#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

template <class D>
VITRAIL_LANES D power_heuristic(D chosen, D other) {
  const D ratio = other / chosen;
  return 1.0 / (1.0 + ratio * ratio);
}

}  // namespace
}  // namespace vitrail::lanes
