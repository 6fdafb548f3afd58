// SPDX-License-Identifier: Apache-2.0
// What light is for people, in their units.
#pragma once

#include <array>

#include "scene/spectra/color.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

// lm/W: luminous efficacy at 540 THz.
inline constexpr double luminous_efficacy = 683.002;
// Of Y as a film has it (∫ S ȳ dλ / ∫ ȳ dλ): cd/m² of radiance, lx of irradiance.
inline constexpr double photometric(double y) { return luminous_efficacy * cie_y_integral_nm * y; }

// The melanopic action spectrum s_mel of CIE S 026/E:2018 at 360, 361 … 830 nm.
const std::array<float, table_size>& melanopic();
// ∫ E s_mel dλ over what D65 has a lumen (1.3262 mW/lm): lx of D65 that act alike, the melanopic equivalent
// daylight illuminance (melanopic EDI).
double melanopic_edi(const Spectrum& irradiance);
// What a unit of irradiance over [low, high] nm, 1 W·m⁻²·nm⁻¹, adds to it.
double melanopic_edi_of_bin(double low_nm, double high_nm);

// McCamy's approximation (1992) of the correlated colour temperature, K; good to 2 K from 2856 to 6504 K.
double correlated_color_temperature(const XYZ& color);

}  // namespace vitrail
