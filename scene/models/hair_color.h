// SPDX-License-Identifier: Apache-2.0
// What gives hair its colour. Absorption is over the radius of a fibre.
#pragma once

#include "scene/spectra/spectrum.h"

namespace vitrail {

// Of concentrations of melanin (d'Eon et al., "An Energy-Conserving Hair Reflectance Model", 2011, as linear
// sRGB).
Spectrum melanin_absorption(double eumelanin, double pheomelanin);

// Hair of this azimuthal roughness has the colour c where its absorption is (ln c / this)² (Chiang et al.
// 2016, eq. 9).
double hair_color_scale(double beta_n);

}  // namespace vitrail
