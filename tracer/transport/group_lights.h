// SPDX-License-Identifier: Apache-2.0
// These functions deposit in films that keep groups of lights.
#pragma once

#include "tracer/transport/tracing.h"

namespace vitrail {

// It is LitBy::group of light along a direction where the discs of suns are seen, too; by_direction is
// without them.
inline constexpr std::uint8_t by_direction_with_discs = GroupedLights::by_direction - 1;
static_assert(most_light_groups <= by_direction_with_discs);

// It is a sample's deposit, of which the film's clamp leaves `left`.
struct Deposited {
  std::uint32_t pixel = 0, sample = 0;
  const SensorWeights* sensor = nullptr;
  double left = 1;
  const Footprint* spread = nullptr;
};

// Deposits as Film::deposit. `value` is what the sensor and the clamp make of `radiance`.
bool deposit_in_groups(Tracing& tracing, const Deposited& deposited, const SampledSpectrum& radiance,
                       const XYZ& value, const LitBy& by);

}  // namespace vitrail
