// SPDX-License-Identifier: Apache-2.0
// These functions convert light to the units of human vision.
#pragma once

#include <array>

#include "scene/spectra/color.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

// It is the luminous efficacy at 540 THz, lm/W.
inline constexpr double luminous_efficacy = 683.002;
// Converts Y as a film has it (∫ S ȳ dλ / ∫ ȳ dλ): a radiance's to cd/m², an irradiance's to lx.
inline constexpr double photometric(double y) { return luminous_efficacy * cie_y_integral_nm * y; }

// Returns the melanopic action spectrum s_mel of CIE S 026/E:2018 at 360, 361 … 830 nm.
const std::array<float, table_size>& melanopic();
// Returns the melanopic equivalent daylight illuminance (melanopic EDI), the lx of D65 that act alike: ∫ E
// s_mel dλ over 1.3262 mW, which a lumen of D65 has.
double melanopic_edi(const Spectrum& irradiance);
// Returns what an irradiance of 1 W·m⁻²·nm⁻¹ over [low, high] nm adds to the melanopic EDI.
double melanopic_edi_of_bin(double low_nm, double high_nm);

// Returns McCamy's approximation (1992) of the correlated colour temperature, K; it is good to 2 K from 2856
// to 6504 K.
double correlated_color_temperature(const XYZ& color);

}  // namespace vitrail
