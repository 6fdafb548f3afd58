// SPDX-License-Identifier: Apache-2.0
// These are values of spectra at the wavelengths of one path: four hero wavelengths (Wilkie et al. 2014).
#pragma once

#include <array>

#include "scene/spectra/spectrum.h"

namespace vitrail {

inline constexpr int hero_count = 4;

// It holds wavelengths in nm and their pdfs in nm⁻¹. Index 0 is the hero: the one that is left after
// dispersion.
struct SampledWavelengths {
  std::array<float, hero_count> lambda_nm{};
  std::array<float, hero_count> pdf{};
};

// It holds one value for each wavelength of a SampledWavelengths.
struct SampledSpectrum {
  std::array<float, hero_count> v{};
  // Returns the value by its number: 0 is the hero.
  float operator[](int i) const { return v[static_cast<std::size_t>(i)]; }
  float& operator[](int i) { return v[static_cast<std::size_t>(i)]; }
  bool operator==(const SampledSpectrum&) const = default;
};

// clang-format off
constexpr SampledSpectrum filled(float x) { return {{x, x, x, x}}; }
constexpr SampledSpectrum operator*(SampledSpectrum a, const SampledSpectrum& b) { for (std::size_t i = 0; i < hero_count; ++i) a.v[i] *= b.v[i]; return a; }
constexpr SampledSpectrum operator*(SampledSpectrum a, float s) { for (float& x : a.v) x *= s; return a; }
constexpr SampledSpectrum operator+(SampledSpectrum a, const SampledSpectrum& b) { for (std::size_t i = 0; i < hero_count; ++i) a.v[i] += b.v[i]; return a; }
constexpr float max_value(const SampledSpectrum& s) { float m = s.v[0]; for (float x : s.v) m = x > m ? x : m; return m; }
constexpr bool is_black(const SampledSpectrum& s) { return max_value(s) <= 0; }
// clang-format on

}  // namespace vitrail
