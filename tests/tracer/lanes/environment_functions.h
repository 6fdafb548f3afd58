// SPDX-License-Identifier: Apache-2.0
// Functions in lanes of what is infinitely far.
#pragma once

#include "tests/tracer/lanes/context.h"
#include "tests/tracer/lanes/lane_table.h"
#include "tracer/lights/environment_lanes.h"

namespace vitrail::lane_tests {
namespace {

LANE_FUNCTION(portable_math, 4, 7) {
  out.number(lanes::portable_sin(in.d(0))), out.number(lanes::portable_cos(in.d(0)));
  out.number(lanes::portable_acos(in.d(0))), out.number(lanes::portable_atan2(in.d(0), in.d(1)));
  out.number(lanes::portable_exp(in.d(2))), out.number(lanes::portable_log(in.d(3)));
  out.number(lanes::portable_pow(in.d(3), in.d(2)));
}
LANE_FUNCTION(sphere_map, 5, 7) {
  const auto direction = in.vector(0);
  for (const auto projection : {SphereProjection::equal_area, SphereProjection::latitude_longitude}) {
    const auto point = lanes::sphere_point(projection, direction);
    out.number(point.x), out.number(point.y);
  }
  out.vector(lanes::equal_area_direction<lanes::Doubles<W>>({in.d(3), in.d(4)}));
}
// With each way to wrap an image, and its texel. Not inlined: they are looked up often.
template <int W>
[[gnu::noinline]] void look_up(const BakedImage& image, lanes::Doubles<W> s, lanes::Doubles<W> t,
                               const SampledWavelengths* of_lane, lanes::Four<lanes::Floats<W>> (&found)[5]) {
  using I = lanes::Ints<W>;
  const auto wavelengths = [&](int j) __attribute__((always_inline))->const SampledWavelengths& {
    return of_lane[j];
  };
  constexpr Wrap wraps[] = {Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::black};
#pragma GCC unroll 1
  for (int i = 0; i < 4; ++i) found[i] = lanes::bilinear(image, s, t, wraps[i], 0, ~0u, wavelengths);
  const I x = lanes::single_at(s, lanes::fill<I>(80), Wrap::clamp),
          y = lanes::single_at(t, lanes::fill<I>(40), Wrap::clamp);
  found[4] = lanes::texel(image, x, y, 0, ~0u, wavelengths);
}
// Of each image at (in[0], in[1]) and the wavelengths from in[2] on.
LANE_FUNCTION(look_up_image, 6, 4 * 5 * fixture_images) {
  SampledWavelengths of_lane[W];
  for (int j = 0; j < W; ++j)
    for (int i = 0; i < hero_count; ++i) of_lane[j].lambda_nm.data()[i] = lanes::lane(in.f(2 + i), j);
  for (const BakedImage* image : context.images) {
    lanes::Four<lanes::Floats<W>> found[5];
    look_up<W>(*image, in.d(0), in.d(1), of_lane, found);
    for (const auto& value : found) out.four(value);
  }
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
