// SPDX-License-Identifier: Apache-2.0
// Published weights. Inside.
#pragma once

#include <array>
#include <span>
#include <utility>

namespace vitrail {

// Direct normal irradiance at air mass 1.5, W·m⁻²·µm⁻¹, by wavelength in nm: ASTM E891-87, table 1, which is
// ISO 9845-1:1992, table 1, column 2.
std::span<const std::pair<double, double>> astm_e891();

// CIE standard illuminant D65 each 5 nm from 300 to 830 nm (ISO 10526, CIE 15).
std::span<const double> cie_d65_5nm();
// CIE 1964 10° observer x̄, ȳ, z̄ each 5 nm from 360 to 830 nm (CIE 15; colour-science 0.4.4).
std::span<const std::array<double, 3>> cie_1964_5nm();

}  // namespace vitrail
