// SPDX-License-Identifier: Apache-2.0
// Functions in lanes of what is infinitely far.
#pragma once

#include "tests/tracer/lanes/context.h"
#include "tests/tracer/lanes/lane_table.h"
#include "tracer/lights/environment_lanes.h"

namespace vitrail::lane_tests {
namespace {

LANE_FUNCTION(portable_math, 2, 4) {
  out.number(lanes::portable_sin(in.d(0))), out.number(lanes::portable_cos(in.d(0)));
  out.number(lanes::portable_acos(in.d(0))), out.number(lanes::portable_atan2(in.d(0), in.d(1)));
}
LANE_FUNCTION(sphere_map, 5, 7) {
  const auto direction = in.vector(0);
  for (const auto projection : {SphereProjection::equal_area, SphereProjection::latitude_longitude}) {
    const auto point = lanes::sphere_point(projection, direction);
    out.number(point.x), out.number(point.y);
  }
  out.vector(lanes::equal_area_direction<lanes::Doubles<W>>({in.d(3), in.d(4)}));
}
// Of each environment, with the numbers in[0], in[1].
LANE_FUNCTION(sample_environment, 2, 3 * fixture_environments) {
  for (std::uint32_t i = 0; i < fixture_environments; ++i)
    out.vector(lanes::sample_direction<lanes::Doubles<W>>(context.environments[i], in.d(0), in.d(1)));
}
// Of each environment, towards in[0…3).
LANE_FUNCTION(see_environment, 3, 5 * fixture_environments) {
  using D = lanes::Doubles<W>;
  for (std::uint32_t i = 0; i < fixture_environments; ++i) {
    const lanes::Seen<D> seen =
        lanes::value_towards<D>(context.environments[i], in.vector(0), in.d(0) >= -2,
                                [&](int) -> const SampledWavelengths& { return *context.some_wavelengths; });
    out.four(seen.radiance), out.number(seen.pdf);
  }
}

}  // namespace
}  // namespace vitrail::lane_tests
