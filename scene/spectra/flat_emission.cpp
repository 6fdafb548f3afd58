// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/flat_emission.h"

#include <cmath>

#include "scene/spectra/color.h"

namespace vitrail {

TabulatedSpectrum inverse_d65() {
  TabulatedSpectrum inverse;
  for (const float value : cie_d65()) inverse.values.push_back(1 / value);
  return inverse;
}

std::optional<double> multiple_of_inverse_d65(const Spectrum& spectrum) {
  const auto* table = std::get_if<TabulatedSpectrum>(&spectrum);
  if (!table) return std::nullopt;
  const auto product = [&](std::size_t i) {
    return static_cast<double>(table->values[i]) * static_cast<double>(cie_d65()[i]);
  };
  const double factor = product(0);
  for (std::size_t i = 0; i < table->values.size(); ++i)
    if (!(std::abs(product(i) - factor) <= 1e-6 * std::abs(factor))) return std::nullopt;
  return static_cast<double>(static_cast<float>(factor));
}

}  // namespace vitrail
