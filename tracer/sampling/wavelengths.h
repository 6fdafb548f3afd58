// SPDX-License-Identifier: Apache-2.0
// Hero wavelengths and what the sensor makes of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "scene/spectra/color.h"
#include "scene/spectra/sampled_spectrum.h"
#include "scene/spectra/spectral_bins.h"

namespace vitrail {

// Four wavelengths, stratified: u, u + ¼, u + ½, u + ¾ (mod 1) through the inverse of a cumulative density
// that is proportional to x̄ + ȳ + z̄ plus a small floor, constant within each nanometre (Wilkie et al. 2014;
// Radziszewski et al. 2009 for the density). u in [0,1).
SampledWavelengths sample_wavelengths(float u);

// A number for that: `u` in [0,1) places the four in their quarters, where its strata are four times as fine
// as they are in the whole; `quarter`, 0 … 3, says which of them is the hero.
inline float number_of_hero(float u, float quarter) { return std::min((u + quarter) / 4, 0x1.fffffep-1f); }

// What sample_wavelengths reads: of each nanometre its density and the sum of those before, and where the
// search for u·cells begins. It ends there or one farther, but where `several` is added.
struct WavelengthTables {
  static constexpr std::int32_t several = 1 << 30;
  const double *pdf, *cumulative;
  const std::uint32_t* first;
  double cells;
};
WavelengthTables wavelength_tables();

// Fixed ones, each the middle of a 16th of ∫ȳ: the mean of a spectrum over them is about its luminance.
const std::array<SampledWavelengths, 4>& luminance_wavelengths();

// What a pixel gets of radiance L at the four wavelengths: XYZ = Σᵢ Lᵢ · weight[·][i], unbiased; and where
// the film keeps spectral bins, Lᵢ·spectral[i] for bin[i], so that the sum's mean is the mean of L over the
// bin.
struct SensorWeights {
  std::array<float, hero_count> x{}, y{}, z{};
  std::array<float, hero_count> spectral{};  // 0: in no bin
  std::array<std::uint16_t, hero_count> bin{};
};
// Three functions of the wavelength, as x̄, ȳ and z̄ are: at 360, 361 … 830 nm.
using Observer = std::array<std::array<float, 3>, table_size>;
// Sees spectra that are constant in the bands of scene/spectra/rgb_bands.h as the linear sRGB colours of
// their numbers: within a band it follows the density of `sample_wavelengths`, so that each of a band's
// wavelengths counts as much as any other; between bands it is 0.
const Observer& band_observer();
// `scale` multiplies them.
SensorWeights sensor_weights(const SampledWavelengths& wavelengths, double scale = 1,
                             const SpectralBins& bins = {}, const Observer& observer = cie_1931());

// SensorWeights::spectral is nowhere greater.
double greatest_bin_weight(const SpectralBins& bins);

inline XYZ sense(const SensorWeights& w, const SampledSpectrum& radiance) {
  XYZ sum;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double l = static_cast<double>(radiance.v[i]);
    sum.x += l * w.x[i];
    sum.y += l * w.y[i];
    sum.z += l * w.z[i];
  }
  return sum;
}

// To float precision.
SampledSpectrum evaluate(const Spectrum& spectrum, const SampledWavelengths& wavelengths);

}  // namespace vitrail
