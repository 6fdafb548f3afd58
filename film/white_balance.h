// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/develop.h"
#include "scene/spectra/color.h"

namespace vitrail {

// Returns daylight of a temperature in kelvin, as lamps are named (c₂ of 1960; D65 is 6500):
// CIE 015:2018, eq. 4.7 to 4.9. Below 4000 K, where CIE has none, it is a blackbody. Throws
// Error if `kelvin` is not above 0.
Chromaticity daylight(double kelvin);

// Turns colours seen under daylight of `kelvin` into those under D65, by Bradford's adaptation, as pbrt-v4's
// films with a `whitebalance` do. Spectra and layers stay as they are; variances of luminance take the
// square of the pixel's change.
void balance_white(Picture& picture, double kelvin);

}  // namespace vitrail
