// SPDX-License-Identifier: Apache-2.0
// Elementary functions from + − × ÷ √ alone: the C library picks variants of sin and exp by CPU, and a
// picture must have the same bits on every machine. Double precision, errors below 1e-15 on the stated
// ranges.
#pragma once

#include <cmath>

namespace vitrail {

inline constexpr double pi = 3.14159265358979323846;

// sin x for |x| ≤ π/4: Taylor to x¹⁷.
constexpr double sin_small(double x) {
  const double x2 = x * x;
  double sum = 0;
  for (int k = 17; k >= 3; k -= 2) sum = (1 + sum) * -x2 / (k * (k - 1));
  return x * (1 + sum);
}

// cos x for |x| ≤ π/4: Taylor to x¹⁸.
constexpr double cos_small(double x) {
  const double x2 = x * x;
  double sum = 0;
  for (int k = 18; k >= 2; k -= 2) sum = (1 + sum) * -x2 / (k * (k - 1));
  return 1 + sum;
}

// sin(πx) for |x| < 2⁵¹.
inline double sin_pi(double x) {
  const double quarters = std::nearbyint(2 * x);
  const double r = pi * (x - quarters / 2);  // |r| ≤ π/4
  const double turn = quarters - 4 * std::floor(quarters / 4);
  if (turn == 0) return sin_small(r);
  if (turn == 1) return cos_small(r);
  return turn == 2 ? -sin_small(r) : -cos_small(r);
}

// eˣ for |x| ≤ 700: x = n·ln2 + r, Taylor of eʳ to r¹⁸.
inline double portable_exp(double x) {
  const double n = std::nearbyint(x * 1.4426950408889634);
  const double r =
      (x - n * 0x1.62e42feep-1) - n * 1.9082149292705877e-10;  // ln2 in two parts, the first of 32 bits
  double sum = 1;
  for (int k = 18; k >= 1; --k) sum = 1 + sum * r / k;
  return std::ldexp(sum, static_cast<int>(n));
}

inline double safe_sqrt(double x) { return x > 0 ? std::sqrt(x) : 0; }

}  // namespace vitrail
