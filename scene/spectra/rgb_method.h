// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace vitrail {

// It says how colours given as RGB become spectra.
enum class RgbMethod {
  jakob_hanika,  // smooth sigmoids (scene/spectra/rgb_to_spectrum.h)
  matrix_r,      // sums of D65 times the colour-matching functions (scene/spectra/matrix_r.h)
  bands,  // constant in three bands, which films see as red, green and blue (scene/spectra/rgb_bands.h)
};

// They are the methods' names in options and manifests.
inline constexpr std::array rgb_method_names{"jakob-hanika", "matrix-r", "bands"};

}  // namespace vitrail
