// SPDX-License-Identifier: Apache-2.0
// A MeasuredSheetBsdf is a sheet of glass by its measured reflectance and transmittance
// (docs/why/measured-glass.md): it has deltas only.
#pragma once

#include <optional>

#include "scene/records/measured_sheet.h"
#include "tracer/bsdf/bsdf.h"

namespace vitrail {

// Light from either side meets the same reflectance and transmittance.
struct MeasuredSheetBsdf {
  const MeasuredSheet* table = nullptr;  // outlives it
  SampledWavelengths wavelengths;
  SampledSpectrum throughput = filled(1);  // of the path: guides its choice
};

struct SheetFractions {
  SampledSpectrum reflected, transmitted;
};

// Interpolates bilinearly in the wavelength and in the cosine of the angle of incidence, in [0, 1].
SheetFractions sheet_fractions(const MeasuredSheet& table, const SampledWavelengths& wavelengths,
                               double cosine);

BsdfValue eval(const MeasuredSheetBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const MeasuredSheetBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const MeasuredSheetBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
