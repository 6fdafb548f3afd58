// SPDX-License-Identifier: Apache-2.0
// These functions return published weights, whose numbers are in standard_tables.txt. Glazing alone uses
// them. A span lasts as long as the program.
#pragma once

#include <array>
#include <span>

#include "glazing/standard.h"

namespace vitrail {

// Returns direct normal irradiance at air mass 1.5, W·m⁻²·µm⁻¹, by wavelength in nm: ASTM E891-87, table 1,
// which is ISO 9845-1:1992, table 1, column 2.
WeightTable astm_e891();

// Returns CIE standard illuminant D65 each 5 nm from 300 to 830 nm (ISO 10526, CIE 15).
std::span<const double> cie_d65_5nm();
// Returns the CIE 1964 10° observer x̄, ȳ, z̄ each 5 nm from 360 to 830 nm (CIE 15).
std::span<const std::array<double, 3>> cie_1964_5nm();
// Returns the components S₀, S₁, S₂ of CIE daylight each 5 nm from 380 to 780 nm (CIE 15).
std::span<const std::array<double, 3>> cie_daylight_5nm();

// They return parts of the sun, each with its interval, that sum to 1, by wavelength in nm. They are EN
// 410:1998, table 2 (CIE 85, global, air mass 1); ISO 9050:1990, table 3 (Moon, direct, air mass 2); and of
// ultraviolet, ISO 9050:1990, table 4, which is EN 410:1998, table 3.
WeightTable en_410_solar();
WeightTable iso_9050_1990_solar();
WeightTable iso_9050_1990_ultraviolet();
// Returns global irradiance at air mass 1.5, W·m⁻²·µm⁻¹: ISO 9845-1:1992, table 1, column 5.
WeightTable iso_9845_global();

// Returns reflectances of test colours 1 to 8 of CIE 13.3-1995 each 5 nm from 380 to 780 nm.
std::span<const std::array<double, 8>> cie_test_colors_5nm();

}  // namespace vitrail
