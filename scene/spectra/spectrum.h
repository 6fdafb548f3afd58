// SPDX-License-Identifier: Apache-2.0
// Spectra are functions of the wavelength. They are not to be confused with their samples (SampledSpectrum).
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace vitrail {

// They bound the visible range that everything is sampled on, nm.
inline constexpr double lambda_min_nm = 360;
inline constexpr double lambda_max_nm = 830;
inline constexpr int table_size = 471;  // values at 360, 361 … 830 nm

// It has the same value at all wavelengths.
struct ConstantSpectrum {
  float value = 0;
  bool operator==(const ConstantSpectrum&) const = default;
};

// It is a reflectance S(λ) = ½ + x/(2√(1+x²)), x = c0·λ² + c1·λ + c2, λ in nm (Jakob & Hanika 2019, eq. 3 and
// 4). c0 = c1 = 0 and c2 = ±∞ stand for the constants 1 and 0. `rgb` is the linear sRGB colour that it was
// fitted to.
struct SigmoidSpectrum {
  float c0 = 0, c1 = 0, c2 = 0;
  std::array<float, 3> rgb{};
  bool operator==(const SigmoidSpectrum&) const = default;
};

// It is an emission of colour rgb: scale · sigmoid(λ) · D65(λ), D65 normalised so that rgb (1,1,1) has
// luminance 1: ∫ S ȳ dλ / ∫ ȳ dλ = 1. `scale` is 2·max(rgb), the sigmoid has colour rgb/scale.
struct RgbIlluminantSpectrum {
  SigmoidSpectrum shape;
  float scale = 0;
  std::array<float, 3> rgb{};
  bool operator==(const RgbIlluminantSpectrum&) const = default;
};

// It is a quantity of colour rgb that may exceed 1 (a coefficient, a factor): scale · sigmoid(λ), as above.
struct RgbUnboundedSpectrum {
  SigmoidSpectrum shape;
  float scale = 0;
  std::array<float, 3> rgb{};
  bool operator==(const RgbUnboundedSpectrum&) const = default;
};

// It is a wavelength in nm and the value there.
using SpectrumSample = std::array<double, 2>;

// It has `table_size` values at 360, 361 … 830 nm, and is linear in between.
struct TabulatedSpectrum {
  std::vector<float> values;
  // They are what `tabulate` made the values of, so that a file that is written says what was read;
  // `sample_factor` multiplies them. Nothing is rendered by them, and the spectrum is 0 beyond their ends. If
  // there are none, the values are all there is.
  std::vector<SpectrumSample> samples{};
  double sample_factor = 1;
  bool operator==(const TabulatedSpectrum& other) const { return values == other.values; }
};

// It is a refractive index n² = 1 + Σ bᵢλ²/(λ² − cᵢ), λ in µm (Sellmeier 1871).
struct SellmeierSpectrum {
  std::array<double, 3> b{};
  std::array<double, 3> c_um2{};
  bool operator==(const SellmeierSpectrum&) const = default;
};

// It is Planck's law at `kelvin`, of luminance `luminance` (∫ S ȳ dλ / ∫ ȳ dλ).
struct BlackbodySpectrum {
  float kelvin = 6500;
  float luminance = 1;
  bool operator==(const BlackbodySpectrum&) const = default;
};

// It is one of `named_spectrum` (scene/spectra/named_spectra.h), by pbrt's name for it: "glass-BK7",
// "metal-Cu-eta". It is kept by name so that it can be written by name; renderers take `resolved`.
struct NamedSpectrum {
  std::string name;
  bool operator==(const NamedSpectrum&) const = default;
};

using Spectrum = std::variant<ConstantSpectrum, SigmoidSpectrum, RgbIlluminantSpectrum, TabulatedSpectrum,
                              SellmeierSpectrum, RgbUnboundedSpectrum, BlackbodySpectrum, NamedSpectrum>;

// Returns the same values without names and blackbodies: cheap to evaluate.
Spectrum resolved(const Spectrum& spectrum);

// Returns the value at a wavelength in nm. It uses + − × ÷ √ only, so it has the same bits on every machine.
double evaluate(const Spectrum& spectrum, double lambda_nm);

// Returns whether the value does not depend on the wavelength.
bool is_constant(const Spectrum& spectrum);

// Returns piecewise linear samples in ascending order of wavelength as a table. Outside their range the
// spectrum is zero, or held at the end value if `extend`. Where all stand at whole nanometres, or outside of
// the visible range, the table has their values. Else each entry is the mean around it, weighted by a tent
// that falls to 0 at the next entries. So integrals are the samples', however narrow a line is. The table
// keeps the samples. Unsorted or duplicate wavelengths, non-finite values and an empty list throw Error.
TabulatedSpectrum tabulate(const std::vector<SpectrumSample>& samples, bool extend);

// Returns samples that say the same: those that the table was made of, or its own.
std::vector<SpectrumSample> samples_of(const TabulatedSpectrum& table);

// Returns Planck's law at `kelvin`, normalised to a maximum of 1 over all wavelengths.
TabulatedSpectrum blackbody(double kelvin);

// Returns the same spectrum times `factor`, staying in its own kind where it can.
Spectrum scaled(const Spectrum& spectrum, double factor);

// They return a·weight_a + b·weight_b and a·b. Where the result is constant, or one of the two times a
// number, it stays of its kind.
Spectrum weighted_sum(const Spectrum& a, double weight_a, const Spectrum& b, double weight_b);
Spectrum product(const Spectrum& a, const Spectrum& b);

// Returns ∫ S(λ) ȳ(λ) dλ / ∫ ȳ(λ) dλ: the luminance-weighted mean, the Y of a pixel that sees radiance S.
double luminance(const Spectrum& spectrum);

}  // namespace vitrail
