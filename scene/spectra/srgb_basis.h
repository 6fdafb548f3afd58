// SPDX-License-Identifier: Apache-2.0
// These are reflectances of red, green and blue that add up to 1: linear in the colour, where a mix of them
// must be (tables whose every value is a colour). Mallett and Yuksel, "Spectral Primary Decomposition for
// Rendering with sRGB Reflectance" (2019).
#pragma once

#include <array>

namespace vitrail {

// It goes from 380 to 780 nm in steps of 5.
extern const std::array<std::array<float, 3>, 81> srgb_basis_table;

// Returns the reflectances of red, green and blue at a wavelength; they are held beyond the ends.
std::array<double, 3> srgb_basis(double lambda_nm);

}  // namespace vitrail
