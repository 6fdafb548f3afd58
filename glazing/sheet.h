// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "glazing/system.h"
#include "scene/records/measured_sheet.h"

namespace vitrail {

// They say what a side scatters of light at the normal, at the wavelengths of the sheets. They are empty
// where nothing is scattered. A side
// lets through as much of light from inside as of light from outside: a Lambertian surface is reciprocal.
struct ScatteredShares {
  std::vector<float> reflected, transmitted;  // their sums are at most 1
};

// A system as rays meet it: what its outside and its inside reflect and let straight through, at each half
// degree, at the wavelengths of its panes in the visible, and what they scatter. Between angles the error is
// below 1e-4 up to 85°. Where light grazes, what is scattered takes the place of what is mirrored.
struct GlazingSheets {
  MeasuredSheet front, back;
  ScatteredShares front_scattered, back_scattered;
};
GlazingSheets sheets_of(const GlazingSystem& system, Polarisation polarisation);

}  // namespace vitrail
