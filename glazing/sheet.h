// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "glazing/system.h"
#include "scene/records/measured_sheet.h"

namespace vitrail {

// ScatteredShares are what a side scatters of light at the normal, at the wavelengths of the sheets. They are
// empty where nothing is scattered. A side lets through as much of light from inside as of light from
// outside: a Lambertian surface is reciprocal.
struct ScatteredShares {
  std::vector<float> reflected, transmitted;  // their sums are at most 1
};

// Sheets are a system as rays meet it: what each side reflects and lets straight through, and what it
// scatters. They have each half degree and the panes' visible wavelengths. Between angles the error is below
// 1e-4 up to 85°. At grazing angles scattered light takes the place of mirrored light.
struct GlazingSheets {
  MeasuredSheet front, back;
  ScatteredShares front_scattered, back_scattered;
};
GlazingSheets sheets_of(const GlazingSystem& system, Polarisation polarisation);

}  // namespace vitrail
