// SPDX-License-Identifier: Apache-2.0
// How true colours are in the light that a glazing lets through.
#pragma once

#include "glazing/system.h"

namespace vitrail {

// General colour rendering index Rₐ of D65 through the glazing against D65 itself, as EN 410 and ISO 9050
// have it: CIE 13.3-1995 with test colours 1 to 8, its von Kries adaptation and U*V*W*; sums each 5 nm from
// 380 to 780 nm. 100 is no change. Empty where no light comes through.
std::optional<double> color_rendering_index(const SystemSpectrum& spectrum);

}  // namespace vitrail
