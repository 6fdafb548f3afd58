// SPDX-License-Identifier: Apache-2.0
// Colour rendering is how true colours are in the light that a glazing lets through.
#pragma once

#include "glazing/system.h"

namespace vitrail {

// Returns the general colour rendering index Rₐ of D65 through the glazing against D65 itself. EN 410 and ISO
// 9050 take CIE 13.3-1995 with test colours 1 to 8, its von Kries adaptation and U*V*W*. It sums each 5 nm
// from 380 to 780 nm. 100 is no change. Returns none where no light comes through.
std::optional<double> color_rendering_index(const SystemSpectrum& spectrum);

}  // namespace vitrail
