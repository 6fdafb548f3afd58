// SPDX-License-Identifier: Apache-2.0
// This file has `phase` of phase.h, for any number of lanes.
#pragma once

#include "scene/geometry/portable_math.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

template <class D>
VITRAIL_LANES D phase(D g, Vector<D> out, Vector<D> in) {
  // It is ≥ (1 − |g|)² > 0.
  const D least = (1.0 - abs(g)) * (1.0 - abs(g));
  const D base = lanes::max(1.0 + g * g + 2.0 * g * dot(out, in), least);
  return (1.0 - g * g) / (4 * pi * base * lanes::sqrt(base));
}

}  // namespace
}  // namespace vitrail::lanes
