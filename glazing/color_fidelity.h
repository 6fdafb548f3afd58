// SPDX-License-Identifier: Apache-2.0
// How alike 99 colours look in the light that a glazing lets through.
#pragma once

#include "glazing/system.h"

namespace vitrail {

// ANSI/IES TM-30-20: 100 is the same as in the reference. `gamut` above 100 is more colourful.
struct ColorFidelity {
  double fidelity = 0, gamut = 0;  // R_f, R_g
  double kelvin = 0;               // correlated colour temperature of the light
};

// Compares D65 through the glazing with Planck's light or CIE daylight of the same colour temperature, in
// CAM02-UCS, by the 10° observer and sums each 5 nm from 380 to 780 nm. Empty where no light comes through.
std::optional<ColorFidelity> color_fidelity(const SystemSpectrum& spectrum);

}  // namespace vitrail
