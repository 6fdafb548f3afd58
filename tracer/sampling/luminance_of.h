// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "scene/spectra/color.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// Returns ∫ S ȳ dλ / ∫ ȳ dλ of S = spectrum(SampledWavelengths), by 4·`groups` wavelengths from 400 to 720
// nm. With 2 groups it is within 5 %, with 16 (every 5 nm) within 1e-3 for sigmoids under D65.
template <class F>
double luminance_of(F&& spectrum, int groups) {
  constexpr int first_nm = 400, last_nm = 720;
  const int count = groups * hero_count;
  double sum = 0, weights = 0;
  for (int group = 0; group < groups; ++group) {
    SampledWavelengths wavelengths;
    std::array<double, hero_count> weight{};
    for (std::size_t i = 0; i < hero_count; ++i) {
      const int k = static_cast<int>(i) * groups + group;
      const int nm = first_nm + (2 * k + 1) * (last_nm - first_nm) / (2 * count);
      wavelengths.lambda_nm[i] = static_cast<float>(nm);
      weight[i] = static_cast<double>(cie_1931()[static_cast<std::size_t>(nm - 360)][1]);
    }
    const SampledSpectrum value = spectrum(wavelengths);
    for (std::size_t i = 0; i < hero_count; ++i) {
      sum += weight[i] * std::max(0.0, static_cast<double>(value.v[i]));
      weights += weight[i];
    }
  }
  return sum / weights;
}

}  // namespace vitrail
