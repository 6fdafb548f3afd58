// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// How colours given as RGB become spectra.
enum class RgbMethod {
  jakob_hanika,  // smooth sigmoids (scene/spectra/rgb_to_spectrum.h)
  matrix_r,      // sums of D65 times the colour-matching functions (scene/spectra/matrix_r.h)
};

}  // namespace vitrail
