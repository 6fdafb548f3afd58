// SPDX-License-Identifier: Apache-2.0
#include "importers/spectra/greatest_value.h"

#include <algorithm>

namespace vitrail {

double greatest_value(const SpectrumParameter& parameter) {
  constexpr double of_texture = 0.8;
  const auto* value = std::get_if<Spectrum>(&parameter);
  if (!value) return of_texture;
  const Spectrum spectrum = resolved(*value);
  double most = 0;
  for (double nm = lambda_min_nm; nm <= lambda_max_nm; nm += 5) most = std::max(most, evaluate(spectrum, nm));
  return most;
}

}  // namespace vitrail
