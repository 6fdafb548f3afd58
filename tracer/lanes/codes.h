// SPDX-License-Identifier: Apache-2.0
// These functions round values as records on a path do (tracer/rays/ray_records.h), in lanes.
#pragma once

#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

// Returns pdf_value(pdf_code(pdf)), which is rounded to bfloat16.
template <class F>
VITRAIL_LANES F rounded_pdf(F pdf) {
  const auto code = cast_bits<std::uint32_t>(pdf);
  return cast_bits<float>((code + 0x7fffu + (code >> 16 & 1u)) & 0xffff0000u);
}
template <class D>
VITRAIL_LANES FloatsLike<D> density_beside(D pdf, std::uint32_t light_samples) {
  return rounded_pdf(to_floats(light_samples == 1 ? pdf : pdf / static_cast<double>(light_samples)));
}

template <class F>
VITRAIL_LANES F rounded_radiance(F value) {
  const auto code = (cast_bits<std::uint32_t>(value) << 1) + 0x80u;
  return cast_bits<float>((code & ~0xffu) >> 1);
}

// The function uses the lowest 10 bits of `random`.
template <class F>
VITRAIL_LANES F rounded_by_chance(F value, std::type_identity_t<WordsLike<F>> random) {
  const auto code = (cast_bits<std::uint32_t>(value) << 1) + (random & 0x3ffu);
  return cast_bits<float>((code & ~0x3ffu) >> 1);
}

// Returns a float that is not above x ≥ 0.
template <class D>
VITRAIL_LANES FloatsLike<D> float_below(D x) {
  using F = FloatsLike<D>;
  const F nearest = to_floats(x), below = cast_bits<float>(cast_bits<std::uint32_t>(nearest) - 1u);
  return select<F>(mask_for<F>(to_doubles(nearest) > x), below, nearest);
}

}  // namespace
}  // namespace vitrail::lanes
