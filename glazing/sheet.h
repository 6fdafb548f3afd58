// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "glazing/system.h"
#include "scene/records/measured_sheet.h"

namespace vitrail {

// A system as rays meet it: what its outside and its inside do, at each half degree, at the wavelengths of
// its panes in the visible. Between angles the error is below 1e-4 up to 85°.
struct GlazingSheets {
  MeasuredSheet front, back;
};
GlazingSheets sheets_of(const GlazingSystem& system, Polarisation polarisation);

}  // namespace vitrail
