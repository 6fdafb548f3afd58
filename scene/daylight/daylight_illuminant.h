// SPDX-License-Identifier: Apache-2.0
// These functions compute the daylight of the CIE (CIE 15, equations 3.2 to 3.5), by its correlated colour
// temperature.
#pragma once

namespace vitrail {

// Says whether the CIE has a daylight of this temperature: 4000 to 25000 K.
bool is_daylight(double color_temperature_k);

// Returns its relative power at a band of the sky's model, 360, 400 … 720 nm, where that at 560 nm is 100.
// D65 is that of 6504 K.
double cie_daylight(double band_nm, double color_temperature_k);

}  // namespace vitrail
