// SPDX-License-Identifier: Apache-2.0
// The light that a InteriorFade (scene/records/medium.h) leaves.
#pragma once

#include "scene/records/medium.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

// Over a distance, ≥ 0, that ends where the medium does.
SampledSpectrum left_by(const InteriorFade& fade, double distance, const SampledWavelengths& wavelengths);

}  // namespace vitrail
