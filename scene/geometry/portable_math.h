// SPDX-License-Identifier: Apache-2.0
// These elementary functions have the same bits on every machine: the C library picks variants of sin and exp
// by CPU.
#pragma once

#include <sleef.h>

#include <cmath>

#include "scene/geometry/pi.h"

namespace vitrail {

// Returns sin x for |x| ≤ π/4: Taylor to x¹⁷.
constexpr double sin_small(double x) {
  const double x2 = x * x;
  double sum = 0;
  for (int k = 17; k >= 3; k -= 2) sum = (1 + sum) * (x2 * (-1.0 / (k * (k - 1))));
  return x * (1 + sum);
}

// Returns cos x for |x| ≤ π/4: Taylor to x¹⁸.
constexpr double cos_small(double x) {
  const double x2 = x * x;
  double sum = 0;
  for (int k = 18; k >= 2; k -= 2) sum = (1 + sum) * (x2 * (-1.0 / (k * (k - 1))));
  return 1 + sum;
}

// Returns sin(πx) for |x| < 2⁵¹.
inline double sin_pi(double x) {
  const double quarters = std::nearbyint(2 * x);
  const double r = pi * (x - quarters / 2);  // |r| ≤ π/4
  const double turn = quarters - 4 * std::floor(quarters / 4);
  if (turn == 0) return sin_small(r);
  if (turn == 1) return cos_small(r);
  return turn == 2 ? -sin_small(r) : -cos_small(r);
}

// These are SLEEF's (Shibata & Petrogalli 2020): its `cinz` variants use no fused multiply-add and have the
// same bits on every machine. Errors are below 1 ulp (u10) or 3.5 ulp (u35).
inline double portable_exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
inline double portable_log(double x) { return Sleef_cinz_logd1_u35purec(x); }
inline double portable_atan2(double y, double x) { return Sleef_cinz_atan2d1_u35purec(y, x); }
inline double portable_erf(double x) { return Sleef_cinz_erfd1_u10purec(x); }
inline double portable_sin(double x) { return Sleef_cinz_sind1_u35purec(x); }
inline double portable_cos(double x) { return Sleef_cinz_cosd1_u35purec(x); }
inline double portable_tan(double x) { return Sleef_cinz_tand1_u35purec(x); }
// Returns acos of x clamped to [−1, 1].
inline double portable_acos(double x) { return Sleef_cinz_acosd1_u35purec(x < -1 ? -1 : x > 1 ? 1 : x); }
// Returns x ≥ 0 to any power.
inline double portable_pow(double x, double y) { return x > 0 ? portable_exp(y * portable_log(x)) : y == 0; }

inline double safe_sqrt(double x) { return x > 0 ? std::sqrt(x) : 0; }

}  // namespace vitrail
