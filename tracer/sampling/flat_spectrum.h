// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "scene/spectra/spectrum.h"

namespace vitrail {

const float* table_of_ones();

// It is a spectrum as numbers that paths side by side read (lanes/spectra.h), whatever its kind is:
// sigmoid · table · scale · factor, multiplied in this order. A part that it has not is 1.
struct FlatSpectrum {
  float c0 = 0, c1 = 0, c2 = std::numeric_limits<float>::infinity();  // SigmoidSpectrum
  float scale = 1, factor = 1;
  bool has_table = false;
  const float* table = table_of_ones();  // of 360, 361 … 830 nm
  const Spectrum* other = nullptr;       // of a kind that has no such numbers: evaluate · factor
};

// Returns the numbers of evaluate(spectrum) · factor, to the bit. `spectrum` has to outlive them.
FlatSpectrum flat_spectrum(const Spectrum& spectrum, float factor = 1);

}  // namespace vitrail
