// SPDX-License-Identifier: Apache-2.0
// These functions turn RGB into smooth spectra after Jakob & Hanika, "A Low-Dimensional Function Space for
// Efficient Spectral Upsampling" (2019).
#pragma once

#include "scene/spectra/color.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

// Returns the sigmoid whose colour under D65 is the linear sRGB colour c, each component in [0,1] (clamped to
// it). It is solved by Gauss–Newton in CIELAB, started from grey. Greys are exact constants.
SigmoidSpectrum reflectance_from_rgb(RGB c);

// Returns the emission of linear sRGB colour c; components may exceed 1, negative ones count as 0.
RgbIlluminantSpectrum emission_from_rgb(RGB c);

// Returns a coefficient or factor of linear sRGB colour c; negative components count as 0. Where none exceeds
// 1, it is the reflectance of that colour.
Spectrum unbounded_from_rgb(RGB c);

}  // namespace vitrail
