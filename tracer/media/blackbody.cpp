// SPDX-License-Identifier: Apache-2.0
#include "tracer/media/blackbody.h"

#include "scene/geometry/portable_math.h"

namespace vitrail {

// B(λ,T)/B(λₘ,T) = r⁵·(eʷ − 1)/(eʷʳ − 1), r = λₘ/λ, where w = c₂/(λₘ·T) is the root of w = 5(1 − e⁻ʷ).
double blackbody_radiance(double kelvin, double lambda_nm) {
  constexpr double least_kelvin = 100, c2_nm_kelvin = 1.438776877e7, w = 4.965114231744276;
  constexpr double exp_w_minus_1 = 142.32492159405578;
  if (!(kelvin > least_kelvin)) return 0;
  const double x = c2_nm_kelvin / (kelvin * lambda_nm), r = x / w;
  if (x > 700) return 0;
  // Of a small x the difference would lose its digits: x·(1 + x/2), within x²/6 of it.
  const double exp_minus_1 = x < 1e-6 ? x * (1 + x / 2) : portable_exp(x) - 1;
  return r * r * r * r * r * exp_w_minus_1 / exp_minus_1;
}

}  // namespace vitrail
