// SPDX-License-Identifier: Apache-2.0
// This file has functions of scene/geometry/portable_math.h for any number of lanes. SLEEF's `cinz` variants
// use no fused multiply-add: those of all widths have the same bits, but for ties of sine and cosine.
#pragma once

#include <sleef.h>

#include "scene/geometry/portable_math.h"
#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

namespace detail {

#if defined(__AVX512F__)
#define VITRAIL_SLEEF_8(name, ulps) static constexpr auto eight = Sleef_cinz_##name##d8_##ulps##avx512fnofma;
#else
#define VITRAIL_SLEEF_8(name, ulps)
#endif
#if defined(__AVX2__)
#define VITRAIL_SLEEF_4(name, ulps) static constexpr auto four = Sleef_cinz_##name##d4_##ulps##avx;
#else
#define VITRAIL_SLEEF_4(name, ulps)
#endif
#if defined(__SSE2__)
#define VITRAIL_SLEEF_2(name, ulps) static constexpr auto two = Sleef_cinz_##name##d2_##ulps##sse2;
#else
#define VITRAIL_SLEEF_2(name, ulps)
#endif
#define VITRAIL_SLEEF(type, name, ulps)                                                 \
  struct type {                                                                         \
    static constexpr auto one = Sleef_cinz_##name##d1_##ulps##purec;                    \
    VITRAIL_SLEEF_2(name, ulps) VITRAIL_SLEEF_4(name, ulps) VITRAIL_SLEEF_8(name, ulps) \
  };
VITRAIL_SLEEF(Sine, sin, u35)
VITRAIL_SLEEF(Cosine, cos, u35)
VITRAIL_SLEEF(ArcCosine, acos, u35)
VITRAIL_SLEEF(ArcTangent, atan2, u35)
VITRAIL_SLEEF(Exponential, exp, u10)
VITRAIL_SLEEF(Logarithm, log, u35)
#undef VITRAIL_SLEEF
#undef VITRAIL_SLEEF_2
#undef VITRAIL_SLEEF_4
#undef VITRAIL_SLEEF_8

// Calls the variant of that width, or works by halves.
template <class Function, class D, class... More>
VITRAIL_LANES D by_sleef(D x, More... more) {
  if constexpr (width<D> == 1) {
    return Function::one(x, more...);
#if defined(__AVX512F__)
  } else if constexpr (width<D> == 8) {
    return reinterpret_cast<D>(
        Function::eight(reinterpret_cast<__m512d>(x), reinterpret_cast<__m512d>(more)...));
#endif
#if defined(__AVX2__)
  } else if constexpr (width<D> == 4) {
    return reinterpret_cast<D>(
        Function::four(reinterpret_cast<__m256d>(x), reinterpret_cast<__m256d>(more)...));
#endif
#if defined(__SSE2__)
  } else if constexpr (width<D> == 2) {
    return reinterpret_cast<D>(
        Function::two(reinterpret_cast<__m128d>(x), reinterpret_cast<__m128d>(more)...));
#endif
  } else if constexpr (width<D> == 2) {
    return D{Function::one(x[0], more[0]...), Function::one(x[1], more[1]...)};
  } else {
    auto half = std::bit_cast<Halves<D>>(x);
    half.low = by_sleef<Function>(half.low, std::bit_cast<Halves<D>>(more).low...);
    half.high = by_sleef<Function>(half.high, std::bit_cast<Halves<D>>(more).high...);
    return std::bit_cast<D>(half);
  }
}

// Calls a function that is reduced by the integer nearest to `steps`, |steps| < 2³¹. In a tie the variant for
// one lane rounds otherwise than the wider ones: ties take that variant.
template <class Function, class D>
VITRAIL_LANES D by_nearest(D x, D steps) {
  D value = by_sleef<Function>(x);
  if constexpr (width < D >> 1) {
    const D part = abs(steps - to_doubles(convert<std::int32_t>(steps)));
    const Mask<D> is_tie = abs(part - 0.5) < 1e-9;
    if (any(is_tie))
      for (int j = 0; j < width<D>; ++j)
        if (is_set(is_tie, j)) set_lane(value, j, Function::one(lane(x, j)));
  }
  return value;
}

}  // namespace detail

// clang-format off
template <class D> VITRAIL_LANES D portable_sin(D x) { return detail::by_nearest<detail::Sine, D>(x, x * (1 / pi)); }  // |x| < 10⁹
template <class D> VITRAIL_LANES D portable_cos(D x) { return detail::by_nearest<detail::Cosine, D>(x, x * (1 / pi) - 0.5); }
template <class D> VITRAIL_LANES D portable_acos(D x) { return detail::by_sleef<detail::ArcCosine>(lanes::clamp<D>(x, -1.0, 1.0)); }
template <class D> VITRAIL_LANES D portable_atan2(D y, D x) { return detail::by_sleef<detail::ArcTangent>(y, x); }
// clang-format on
template <class D>
VITRAIL_LANES D portable_log(D x) {
  return detail::by_sleef<detail::Logarithm>(x);
}
template <class D>
VITRAIL_LANES D portable_exp(D x) {
  return detail::by_nearest<detail::Exponential, D>(x, lanes::clamp<D>(x * 1.4426950408889634, -2e9, 2e9));
}
// Returns x ≥ 0 to any power.
template <class D>
VITRAIL_LANES D portable_pow(D x, D y) {
  const Mask<D> has_logarithm = x > 0;
  const D power = portable_exp<D>(y * portable_log(select<D>(has_logarithm, x, fill<D>(1))));
  return select<D>(has_logarithm, power, select<D>(y == 0, fill<D>(1), fill<D>(0)));
}

}  // namespace
}  // namespace vitrail::lanes
