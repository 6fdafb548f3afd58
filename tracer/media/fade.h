// SPDX-License-Identifier: Apache-2.0
// These media fade as POV-Ray's interiors do (scene/records/medium.h).
#pragma once

#include "scene/records/medium.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// Returns the share of light that is left over a distance, ≥ 0, which ends where the medium does.
SampledSpectrum left_by(const InteriorFade& fade, double distance, const SampledWavelengths& wavelengths);

}  // namespace vitrail
