// SPDX-License-Identifier: Apache-2.0
// Colour fidelity is how alike 99 colours look in the light that a glazing lets through.
#pragma once

#include "glazing/system.h"

namespace vitrail {

// These are indices of ANSI/IES TM-30-20: 100 is the reference; `gamut` above 100 is more colourful.
struct ColorFidelity {
  double fidelity = 0, gamut = 0;  // R_f, R_g
  double kelvin = 0;               // correlated colour temperature of the light
};

// Compares D65 through the glazing with Planck's light or CIE daylight of the same colour temperature, in
// CAM02-UCS, by the 10° observer. It sums each 5 nm from 380 to 780 nm. Returns none without light.
std::optional<ColorFidelity> color_fidelity(const SystemSpectrum& spectrum);

}  // namespace vitrail
