// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/rgb_bands.h"

#include <algorithm>

#include "scene/spectra/matrix_r.h"

namespace vitrail {

namespace {

RGB to_rgb(const std::array<float, 3>& c) { return {c[0], c[1], c[2]}; }

}  // namespace

Spectrum band_spectrum(RGB c) {
  const std::array<float, 3> values{static_cast<float>(std::max(c.r, 0.0)),
                                    static_cast<float>(std::max(c.g, 0.0)),
                                    static_cast<float>(std::max(c.b, 0.0))};
  if (values[0] == values[1] && values[1] == values[2]) return ConstantSpectrum{values[0]};
  TabulatedSpectrum table;
  table.values.reserve(table_size);
  for (int i = 0; i < table_size; ++i)
    table.values.push_back(values[band_of(static_cast<float>(lambda_min_nm) + static_cast<float>(i))]);
  return table;
}

Spectrum in_bands(const Spectrum& spectrum) {
  if (is_constant(spectrum)) return ConstantSpectrum{static_cast<float>(evaluate(spectrum, lambda_min_nm))};
  if (const auto* s = std::get_if<SigmoidSpectrum>(&spectrum)) return band_spectrum(to_rgb(s->rgb));
  if (const auto* s = std::get_if<RgbUnboundedSpectrum>(&spectrum)) return band_spectrum(to_rgb(s->rgb));
  if (const auto* s = std::get_if<RgbIlluminantSpectrum>(&spectrum)) return band_spectrum(to_rgb(s->rgb));
  if (std::holds_alternative<BlackbodySpectrum>(spectrum))
    return band_spectrum(xyz_to_srgb(to_xyz(spectrum)));
  return band_spectrum(reflected_rgb(resolved(spectrum)));
}

}  // namespace vitrail
