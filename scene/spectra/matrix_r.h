// SPDX-License-Identifier: Apache-2.0
// These functions turn RGB into reflectances by Matrix-R: Cohen & Kappauf, "Metameric color stimuli,
// fundamental metamers, and Wyszecki's metameric blacks", American Journal of Psychology 95 (1982).
#pragma once

#include <array>

#include "scene/spectra/color.h"
#include "scene/spectra/rgb_method.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

// There are values at 360, 365 … 830 nm, linear in between.
inline constexpr std::size_t matrix_r_bands = 95;
using BandReflectance = std::array<double, matrix_r_bands>;

// Returns the fundamental metamer of linear sRGB colour c under D65: N* = A(AᵀA)⁻¹T, the only one that is a
// sum of D65 times the colour-matching functions. It leaves [0, 1]: white's reaches 1.4.
BandReflectance fundamental_metamer(RGB c);

// Returns N* and the least metameric black, in the square of its values, that keeps every value in [0, 1].
// The nearest point of {AᵀS = T, 0 ≤ S ≤ 1} to N* is S = clamp(A·λ), λ ∈ ℝ³, so that three equations are to
// be solved (Newton's method on a convex function). Within 0.01 of white 1 − S is scaled from a colour
// farther off. Greys are exact constants; components of c are clamped to [0, 1].
BandReflectance matrix_r_reflectance(RGB c);

// It is the same S in four numbers: 1 − part·(1 − clamp(a(λ)·weights)), `a` as below. Greys have no weights,
// and `part` 1 − grey.
struct MatrixRReflectance {
  std::array<double, 3> weights{};
  double part = 0;
};
MatrixRReflectance matrix_r_weights(RGB c);

// It holds A of the bands about a wavelength, D65 times x̄, ȳ, z̄ over 5 nm, and the share of the upper band:
// it is the reflectance that is linear between the bands. The values are held beyond 360 and 830 nm.
struct MatrixRBasis {
  std::array<float, 3> below{}, above{};
  float part_above = 0;
};
MatrixRBasis matrix_r_basis(float lambda_nm);

// They return the linear sRGB colour of a reflectance under D65. A Spectrum is taken at 1 nm steps.
RGB reflected_rgb(const BandReflectance& reflectance);
RGB reflected_rgb(const Spectrum& reflectance);

TabulatedSpectrum tabulated(const BandReflectance& reflectance);

// Returns `resolved`, where each spectrum given as RGB becomes one by the method: scale · S, and D65 where it
// shines. Greys stay as they are, constants. By bands it is `in_bands` (scene/spectra/rgb_bands.h).
Spectrum resolved(const Spectrum& spectrum, RgbMethod method);

}  // namespace vitrail
