// SPDX-License-Identifier: Apache-2.0
// These functions compute hair's absorption from its colour or pigment. Absorption is per radius of a fibre.
#pragma once

#include "scene/spectra/spectrum.h"

namespace vitrail {

// Returns the absorption of concentrations of melanin (d'Eon et al., "An Energy-Conserving Hair Reflectance
// Model", 2011, as linear sRGB).
Spectrum melanin_absorption(double eumelanin, double pheomelanin);

// Returns the scale s for hair of this azimuthal roughness: it has the colour c where its absorption is (ln c
// / s)² (Chiang et al. 2016, eq. 9).
double hair_color_scale(double beta_n);

}  // namespace vitrail
