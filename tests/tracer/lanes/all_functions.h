// SPDX-License-Identifier: Apache-2.0
// Each function of tracer/lanes by its name: what lanes_test.cpp holds to the scalar one.
#pragma once

#include "tests/tracer/lanes/environment_functions.h"
#include "tests/tracer/lanes/glossy_functions.h"
#include "tests/tracer/lanes/lane_table.h"
#include "tests/tracer/lanes/sphere_functions.h"
#include "tests/tracer/lanes/stage_functions.h"
#include "tracer/bsdf/fresnel_lanes.h"
#include "tracer/bsdf/local_lanes.h"
#include "tracer/lanes/codes.h"
#include "tracer/lanes/directions.h"

namespace vitrail::lane_tests {
namespace {

LANE_FUNCTION(stream_seed, 6, 2) { out.word64(lanes::stream_seed(in.l(0), in.l(2), in.l(4))); }
LANE_FUNCTION(sample_seed, 3, 2) { out.word64(lanes::sample_seed(7, in.u(0), in.u(1))); }
LANE_FUNCTION(random_bits, 2, 2) { out.word64(lanes::random_bits(in.l(0))); }
LANE_FUNCTION(sample_4d, 3, 9) {
  out.four(lanes::sample_4d(7, in.u(0), in.u(1), in.u(2)));
  const auto three = lanes::sample_4d<Wanted::three>(7, in.u(0), in.u(1), in.u(2));
  const auto two = lanes::sample_4d<Wanted::two>(7, in.u(0), in.u(1), in.u(2));
  for (int i = 0; i < 3; ++i) out.number(three[i]);
  for (int i = 0; i < 2; ++i) out.number(two[i]);
}
LANE_FUNCTION(numbers_of_candidate, 4, 16 * 4) {
  const lanes::Four<lanes::Floats<W>> u{{in.f(0), in.f(1), in.f(2), in.f(3)}};
  for (std::uint32_t k = 0; k < most_candidates; ++k) out.four(lanes::numbers_of_candidate(u, k));
}
LANE_FUNCTION(encode_direction, 3, 2) {
  const auto code = lanes::encode_direction(in.vector(0));
  out.number(code.first), out.number(code.second);
}
LANE_FUNCTION(decode_direction, 2, 3) {
  out.vector(lanes::decode_direction(lanes::Code<lanes::Words<W>>{in.u(0), in.u(1)}));
}
LANE_FUNCTION(decode_normal, 1, 3) { out.vector(lanes::decode_normal(in.u(0))); }
LANE_FUNCTION(normalize, 3, 3) { out.vector(lanes::normalize(in.vector(0))); }
LANE_FUNCTION(frame_of, 3, 6) {
  const auto frame = lanes::frame_of(in.vector(0));
  out.vector(frame.tangent), out.vector(frame.bitangent);
}
LANE_FUNCTION(frame_around, 7, 15) {
  const auto frame = lanes::frame_around(in.vector(0), in.vector(3), in.d(6));
  out.vector(frame.tangent), out.vector(frame.bitangent), out.vector(frame.normal);
  out.vector(frame.to_local(in.vector(3))), out.vector(frame.to_world(in.vector(3)));
}
LANE_FUNCTION(sample_cosine_hemisphere, 2, 3) {
  out.vector(lanes::sample_cosine_hemisphere(in.f(0), in.f(1)));
}
LANE_FUNCTION(attainable, 1, 1) { out.number(lanes::attainable(in.d(0))); }
LANE_FUNCTION(fresnel_dielectric, 2, 1) { out.number(lanes::fresnel_dielectric(in.d(0), in.d(1))); }
LANE_FUNCTION(refract, 7, 4) {
  lanes::Vector<lanes::Doubles<W>> refracted;
  const auto goes = lanes::refract(in.vector(0), in.vector(3), in.d(6), refracted);
  const auto nothing = lanes::fill<lanes::Doubles<W>>(Vector3d{});
  out.mask(goes), out.vector(lanes::select<lanes::Doubles<W>>(goes, refracted, nothing));
}
LANE_FUNCTION(fresnel_conductor, 3, 1) { out.number(lanes::fresnel_conductor(in.d(0), in.d(1), in.d(2))); }
LANE_FUNCTION(density_beside, 1, 2) {
  out.number(lanes::density_beside(in.d(0), 1)), out.number(lanes::density_beside(in.d(0), 6));
}
LANE_FUNCTION(rounded_radiance, 1, 1) { out.number(lanes::rounded_radiance(in.f(0))); }
LANE_FUNCTION(rounded_by_chance, 2, 1) { out.number(lanes::rounded_by_chance(in.f(0), in.u(1))); }
LANE_FUNCTION(order_of_min_and_max, 2, 5) {
  const auto a = in.d(0), b = in.d(1);
  out.number(lanes::min(a, b)), out.number(lanes::max(a, b));
  out.number(lanes::clamp(a, 0.0, 1.0)), out.number(lanes::safe_sqrt(a));
  out.number(lanes::fill<lanes::Doubles<W>>(-0.0));
}
// Rounding to float, which an optimiser may lose between doubles.
LANE_FUNCTION(rounding_to_float, 2, 1) {
  using D = lanes::Doubles<W>;
  const D rounded = lanes::to_doubles(lanes::to_floats(in.d(0)));
  out.number(lanes::select<D>(in.d(1) > 0, rounded, D{}));
}

template <int W, class... F>
inline constexpr LaneFunction table[] = {{F::title, F::ins, F::outs, run<F, W>}...};

template <int W>
constexpr LaneFunctions functions_of(const char* set) {
  const auto& all =
      table<W, stream_seed, sample_seed, random_bits, sample_4d, numbers_of_candidate, encode_direction,
            decode_direction, decode_normal, normalize, frame_of, frame_around, sample_cosine_hemisphere,
            attainable, fresnel_dielectric, refract, fresnel_conductor, density_beside, rounded_radiance,
            rounded_by_chance, order_of_min_and_max, rounding_to_float, sigmoid, table_value, flat_spectrum,
            wavelengths, plain_interaction, interaction_with_normals, interaction_with_uv,
            interaction_with_both, offset_origin, depart, choose_of_few_lights, choose_of_many_lights,
            choose_of_two_lights, draw_emitter, choose_by_power, choose_of_none, aim, shadow_radiance,
            draw_triangle, sample_sphere, sphere_crossings, aim_at_sphere, quick_math, microfacets, phase,
            conductor, layer_random, coating, rough_dielectric, sheet, plastic, principled, finish,
            portable_math, sphere_map, look_up_image, sample_environment, see_environment>;
  return {set, W, all, sizeof all / sizeof all[0]};
}

}  // namespace
}  // namespace vitrail::lane_tests
