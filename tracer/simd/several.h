// SPDX-License-Identifier: Apache-2.0
// This file holds more than one float a lane in one register. Half of the register that W doubles take is
// free where floats are side by side. Number r of lane j, of W lanes, is element r·W + j.
#pragma once

#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

namespace detail {

#if defined(__AVX512F__)
inline constexpr std::size_t register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr std::size_t register_bytes = 32;
#else
inline constexpr std::size_t register_bytes = 16;
#endif

template <class F>
inline constexpr int floats_a_lane = width<F> == 1                     ? 4
                                     : 2 * sizeof(F) <= register_bytes ? 2
                                                                       : 1;

// Returns the elements J of a and b together.
template <class To, class F, int... J>
VITRAIL_LANES To shuffled(F a, F b, std::integer_sequence<int, J...>) {
  return __builtin_shufflevector(a, b, J...);
}
template <class To, int First, class F, int... J>
VITRAIL_LANES To part(F a, std::integer_sequence<int, J...>) {
  return __builtin_shufflevector(a, a, (First + J)...);
}

}  // namespace detail

// There are four floats of one lane; of more lanes two each, where a register holds them.
template <class F>
using Several = Lanes<float, detail::floats_a_lane<F> * width<F>>;

// Returns x for each number of a lane.
template <class F>
VITRAIL_LANES Several<F> repeated(F x) {
  if constexpr (width<F> == 1)
    return fill<Several<F>>(x);
  else if constexpr (detail::floats_a_lane<F> == 1)
    return x;
  else
    return detail::shuffled<Several<F>>(x, x, std::make_integer_sequence<int, 2 * width<F>>{});
}

// They are values at the four wavelengths of each lane.
template <class F>
struct Spectra {
  static constexpr int count = 4 / detail::floats_a_lane<F>;
  Several<F> v[count];
};

template <class F>
VITRAIL_LANES Spectra<F> joined(const Four<F>& s) {
  Spectra<F> result;
  if constexpr (width<F> == 1) {
    result.v[0] = Several<F>{s[0], s[1], s[2], s[3]};
  } else if constexpr (detail::floats_a_lane<F> == 1) {
    for (int i = 0; i < 4; ++i) result.v[i] = s[i];
  } else {
    constexpr auto all = std::make_integer_sequence<int, 2 * width<F>>{};
    for (int i = 0; i < 2; ++i) result.v[i] = detail::shuffled<Several<F>>(s[2 * i], s[2 * i + 1], all);
  }
  return result;
}

template <class F>
VITRAIL_LANES Four<F> parted(const Spectra<F>& s) {
  Four<F> result;
  if constexpr (width<F> == 1) {
    for (int i = 0; i < 4; ++i) result[i] = s.v[0][i];
  } else if constexpr (detail::floats_a_lane<F> == 1) {
    for (int i = 0; i < 4; ++i) result[i] = s.v[i];
  } else {
    constexpr auto lanes = std::make_integer_sequence<int, width<F>>{};
    for (int i = 0; i < 2; ++i) {
      result[2 * i] = detail::part<F, 0>(s.v[i], lanes);
      result[2 * i + 1] = detail::part<F, width<F>>(s.v[i], lanes);
    }
  }
  return result;
}

}  // namespace
}  // namespace vitrail::lanes
