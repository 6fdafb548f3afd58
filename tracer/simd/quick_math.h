// SPDX-License-Identifier: Apache-2.0
// These are elementary functions where single precision is enough, for any number of lanes: five times as
// fast as those of portable_math.h. They too have the same bits on every machine: sums, products and
// quotients in a fixed order.
#pragma once

#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

// Returns c₀ + c₁x + c₂x² + …: the even and the odd powers are summed side by side, for half the latency.
template <class D, class... Coefficients>
VITRAIL_LANES D polynomial(D x, Coefficients... coefficients) {
  constexpr int count = sizeof...(coefficients);
  const double c[count + 1] = {static_cast<double>(coefficients)..., 0};
  const D x2 = x * x;
  D even = fill<D>(0), odd = fill<D>(0);
  for (int i = count / 2 * 2 + 2; i > 0; i -= 2) {
    if (i - 1 <= count) odd = odd * x2 + c[i - 1];
    if (i - 2 <= count) even = even * x2 + c[i - 2];
  }
  return even + x * odd;
}

// Returns eˣ for x ≤ 700, to 1e-11 of its value; 0 below −700. (It is 2ⁿ·eʳ with Taylor's series to r⁹,
// |r| ≤ ln 2/2.)
template <class D>
VITRAIL_LANES D quick_exp(D x) {
  constexpr double round = 0x1.8p52;  // adding it leaves no bits for a fraction
  const D n = (x * 1.4426950408889634 + round) - round;
  const D r = x - n * 0.6931471805599453;
  // |n| < 1023 where the result counts: 32 bits hold it.
  const auto exponent = convert<std::uint64_t>(
      cast_bits<std::uint32_t>(convert<std::int32_t>(select<D>(x > -700, n, fill<D>(0))) + 1023));
  const D power = cast_bits<double>(exponent << 52);
  const D value = power * polynomial(r, 1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040,
                                     1.0 / 40320, 1.0 / 362880);
  return select<D>(x > -700, value, fill<D>(0));
}

// Returns ln x for normal x > 0, to 1e-10 absolute. (It is 2·artanh((m − 1)/(m + 1)) of the mantissa,
// 1/√2 < m ≤ √2.)
template <class D>
VITRAIL_LANES D quick_log(D x) {
  const auto all_bits = cast_bits<std::uint64_t>(x);
  constexpr std::uint64_t half_root = 0x3fe6a09e667f3bcd;  // 1/√2
  const auto high = convert<std::uint32_t>((all_bits - half_root) >> 32);
  const auto exponent = cast_bits<std::int32_t>(high) >> 20;
  const auto shifted = convert<std::uint64_t>(cast_bits<std::uint32_t>(exponent)) << 52;
  const D m = cast_bits<double>(all_bits - shifted);
  const D s = (m - 1.0) / (m + 1.0), s2 = s * s;
  return to_doubles(exponent) * 0.6931471805599453 +
         2.0 * s * polynomial(s2, 1, 1.0 / 3, 1.0 / 5, 1.0 / 7, 1.0 / 9, 1.0 / 11);
}

// Returns erf x for x ≥ 0, to 1.5e-7, given e^(−x²) (Abramowitz & Stegun 1964, 7.1.26).
template <class D>
VITRAIL_LANES D quick_erf(D x, D gauss) {
  const D t = 1.0 / (1.0 + 0.3275911 * x);
  return 1.0 - t * polynomial(t, 0.254829592, -0.284496736, 1.421413741, -1.453152027, 1.061405429) * gauss;
}

// It holds the cosine and sine of 2π·turn, 0 ≤ turn ≤ 1, to 1e-12.
template <class D>
struct Circle {
  D cosine, sine;
};
template <class D>
VITRAIL_LANES Circle<D> quick_circle(D turn) {
  const auto quarter = convert<std::int32_t>(4.0 * turn + 0.5);
  const D r = 6.283185307179586 * (turn - 0.25 * to_doubles(quarter)), r2 = r * r;  // |r| ≤ π/4
  const D s = r * polynomial(r2, 1, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800,
                             1.0 / 6227020800);
  const D c = polynomial(r2, 1, -1.0 / 2, 1.0 / 24, -1.0 / 720, 1.0 / 40320, -1.0 / 3628800, 1.0 / 479001600);
  const Mask<D> odd = mask_for<D>((quarter & 1) != 0), lower = mask_for<D>((quarter & 2) != 0),
                left = mask_for<D>(((quarter + 1) & 2) != 0);
  const D along = select<D>(odd, s, c), across = select<D>(odd, c, s);
  return {select<D>(left, -along, along), select<D>(lower, -across, across)};
}

// Returns x with erf x = y for |y| < 1, to 2e-7 of its value (Giles 2012).
template <class D>
VITRAIL_LANES D inverse_erf(D y) {
  const D w = -quick_log(lanes::max((1.0 - y) * (1.0 + y), fill<D>(1e-15)));
  const D middle = polynomial(w - 2.5, 1.50140941, 0.246640727, -0.00417768164, -0.00125372503, 0.00021858087,
                              -4.39150654e-06, -3.5233877e-06, 3.43273939e-07, 2.81022636e-08);
  const Mask<D> near = w < 5;
  if (all(near)) return y * middle;
  const D end = polynomial(lanes::sqrt(w) - 3.0, 2.83297682, 1.00167406, 0.00943887047, -0.0076224613,
                           0.00573950773, -0.00367342844, 0.00134934322, 0.000100950558, -0.000200214257);
  return y * select<D>(near, middle, end);
}

}  // namespace
}  // namespace vitrail::lanes
