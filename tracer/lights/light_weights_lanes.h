// SPDX-License-Identifier: Apache-2.0
// This file has weigh of light_tree.h: the eight children of a node side by side.
#pragma once

#include "tracer/lights/light_tree.h"
#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

namespace detail {

VITRAIL_LANES Floats<8> load(const LightNode::Lanes& x) { return std::bit_cast<Floats<8>>(x); }
VITRAIL_LANES Words<8> load(const LightNode::Pairs& x) { return std::bit_cast<Words<8>>(x); }
VITRAIL_LANES Floats<8> load(const LightNode::Halves& x) {
  Words<8> bits;
  for (std::size_t i = 0; i < 8; ++i) bits[i] = std::uint32_t{x[i]} << 16;
  return cast_bits<float>(bits);
}
VITRAIL_LANES Floats<8> lower_integer(Words<8> pair) {
  return to_floats(cast_bits<std::int32_t>(pair << 16) >> 16);
}
VITRAIL_LANES Floats<8> upper_integer(Words<8> pair) {
  return to_floats(cast_bits<std::int32_t>(pair) >> 16);
}
VITRAIL_LANES void store(float (&to)[8], Floats<8> x) { __builtin_memcpy(to, &x, sizeof(x)); }

}  // namespace detail

// Returns power · cos θ′ / max(d, near)², or 0 where θ′ ≥ θ_e. θ′ = θ − θ_o − θ_u is the least angle between
// a normal of the child and the direction to p, and θ_u the half angle of its sphere from p. All angles are
// held by cosines and sines.
VITRAIL_LANES void weigh(const LightNode& node, Point3f p, LightWeights& result) {
  using F = Floats<8>;
  constexpr float of_unit = 1 / LightNode::unit, least_distance2 = LightNode::least_distance2;
  const auto larger = [](F a, F b) __attribute__((always_inline)) { return select<F>(a > b, a, b); };
  const auto one = fill<F>(1), zero = fill<F>(0);
  const F x = p.x - detail::load(node.center_x), y = p.y - detail::load(node.center_y),
          z = p.z - detail::load(node.center_z);
  const F d2 = larger(x * x + y * y + z * z, fill<F>(least_distance2));
  const F inverse_d = 1.0f / lanes::sqrt(d2), scale = inverse_d * of_unit;
  const Words<8> axis_xy = detail::load(node.axis_xy), axis_z_cos_o = detail::load(node.axis_z_cos_o),
                 radius2_power = detail::load(node.radius2_power);
  const F along = (x * detail::lower_integer(axis_xy) + y * detail::upper_integer(axis_xy) +
                   z * detail::lower_integer(axis_z_cos_o)) *
                  scale;
  const F signed_radius2 = cast_bits<float>(radius2_power << 16),
          power = cast_bits<float>(radius2_power & 0xffff0000u);
  const F radius2 = abs(signed_radius2);
  const F turned = select<F>(signed_radius2 < 0, -along, along);
  const F cosine = larger(along, turned);
  const F sine = lanes::sqrt(larger(zero, 1.0f - cosine * cosine));
  const F share = radius2 * inverse_d * inverse_d, sin2_u = select<F>(one < share, one, share);
  const F sin_u = lanes::sqrt(sin2_u), cos_u = lanes::sqrt(1.0f - sin2_u);
  const F cos_o = detail::upper_integer(axis_z_cos_o) * of_unit;
  const F sin_o = lanes::sqrt(larger(zero, 1.0f - cos_o * cos_o));

  const F cos_beyond_o = cosine * cos_o + sine * sin_o;
  const F sin_beyond_o = sine * cos_o - cosine * sin_o;
  const F cos1 = select<F>(cosine >= cos_o, one, cos_beyond_o);
  const F sin1 = select<F>(cosine >= cos_o, zero, sin_beyond_o);
  const F cos_beyond_u = cos1 * cos_u + sin1 * sin_u;
  const F cos_outside = select<F>(cos1 >= cos_u, one, cos_beyond_u);
  const F cos2 = select<F>(radius2 >= d2, one, cos_outside);
  const F cos_e = select<F>(power < 0, fill<F>(1 - 1e-4f), zero);
  const F reached = select<F>(cos2 > cos_e, cos2, zero);
  const F child = abs(power) * reached / larger(larger(d2, radius2), detail::load(node.near2));
  detail::store(result.child, child);
  detail::store(result.alike, cosine - LightNode::alike_ratio * (sin_u + sin_o));
  double sum = 0;
  for (int i = 0; i < 8; ++i) result.up_to[i] = sum += static_cast<double>(lane(child, i));
}

}  // namespace
}  // namespace vitrail::lanes
