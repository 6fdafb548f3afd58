// SPDX-License-Identifier: Apache-2.0
// This file has what fresnel.h declares, for any number of lanes.
#pragma once

#include "tracer/simd/lanes.h"

namespace vitrail::lanes {
namespace {

// Returns the reflectance at one wavelength.
template <class D>
VITRAIL_LANES D fresnel_conductor(D cosine, D eta, D k) {
  const D cos2 = cosine * cosine, sin2 = 1.0 - cos2;
  // (a + i·b)² = (eta + i·k)² − sin²θ: the index times the cosine of the complex angle of refraction.
  const D real = eta * eta - k * k - sin2, imaginary = 2.0 * eta * k;
  const D modulus = lanes::sqrt(real * real + imaginary * imaginary);  // a² + b²
  const D a = safe_sqrt((modulus + real) / 2.0);
  const D s_sum = modulus + cos2, s_difference = 2.0 * a * cosine;
  const D p_sum = modulus * cos2 + sin2 * sin2, p_difference = s_difference * sin2;
  const D s = (s_sum - s_difference) / (s_sum + s_difference);
  // The two polarisations agree at normal incidence, and p_sum may vanish only with cosine.
  const D p_over_s =
      select<D>(p_sum + p_difference > 0, (p_sum - p_difference) / (p_sum + p_difference), fill<D>(1));
  // The sum is 0 where the cosine is 0 and the indices match.
  return select<D>(s_sum + s_difference > 0, lanes::clamp<D>(s * (1.0 + p_over_s) / 2.0, 0.0, 1.0),
                   fill<D>(1));
}

}  // namespace
}  // namespace vitrail::lanes
