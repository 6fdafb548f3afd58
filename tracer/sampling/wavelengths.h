// SPDX-License-Identifier: Apache-2.0
// This file has hero wavelengths and what the sensor makes of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "scene/spectra/color.h"
#include "scene/spectra/sampled_spectrum.h"
#include "scene/spectra/spectral_bins.h"

namespace vitrail {

// Returns four wavelengths, stratified: the inverse of a cumulative density at u, u + ¼, u + ½, u + ¾ (mod
// 1), u in [0,1). The density is proportional to x̄ + ȳ + z̄ plus a small floor, constant within each
// nanometre (Wilkie et al. 2014; Radziszewski et al. 2009 for the density).
SampledWavelengths sample_wavelengths(float u);

// Returns a number for sample_wavelengths. `u` in [0,1) places the four in their quarters, where its strata
// are four times as fine as in the whole. `quarter`, 0 … 3, says which of them is the hero.
inline float number_of_hero(float u, float quarter) { return std::min((u + quarter) / 4, 0x1.fffffep-1f); }

// sample_wavelengths reads these: for each nanometre its density and the sum of those before, and where the
// search for u·cells begins. The search ends there or one farther, but where `several` is added.
struct WavelengthTables {
  static constexpr std::int32_t several = 1 << 30;
  const double *pdf, *cumulative;
  const std::uint32_t* first;
  double cells;
};
WavelengthTables wavelength_tables();

// Returns fixed wavelengths, each the middle of a 16th of ∫ȳ: the mean of a spectrum over them is about its
// luminance.
const std::array<SampledWavelengths, 4>& luminance_wavelengths();

// They are what a pixel gets of radiance L at the four wavelengths: XYZ = Σᵢ Lᵢ · weight[·][i], unbiased.
// Where the film keeps spectral bins, bin[i] gets Lᵢ·spectral[i], so that the sum's mean is the mean of L
// over the bin.
struct SensorWeights {
  std::array<float, hero_count> x{}, y{}, z{};
  std::array<float, hero_count> spectral{};  // 0: in no bin
  std::array<std::uint16_t, hero_count> bin{};
};
// It is three functions of the wavelength, as x̄, ȳ and z̄ are: at 360, 361 … 830 nm.
using Observer = std::array<std::array<float, 3>, table_size>;
// Returns an observer that sees spectra that are constant in the bands of scene/spectra/rgb_bands.h as the
// linear sRGB colours of their numbers. Within a band it follows the density of `sample_wavelengths`, so that
// all of a band's wavelengths count alike; between bands it is 0.
const Observer& band_observer();
// `scale` multiplies the weights.
SensorWeights sensor_weights(const SampledWavelengths& wavelengths, double scale = 1,
                             const SpectralBins& bins = {}, const Observer& observer = cie_1931());

// Returns a weight that SensorWeights::spectral never exceeds.
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

// Evaluates to float precision.
SampledSpectrum evaluate(const Spectrum& spectrum, const SampledWavelengths& wavelengths);

}  // namespace vitrail
