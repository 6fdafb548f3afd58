// SPDX-License-Identifier: Apache-2.0
// This function tells how far wavelengths part in a slab of glass.
#pragma once

#include "tracer/transport/traveller.h"

namespace vitrail {

// Wavelengths leave a slab beside each other, thickness · (tan θ_a − tan θ_b) apart along its face. Returns
// whether that is more than an eighth of a pixel across their way. `eta` is that of `refract` where they
// leave, and `outside` the cosine there. The result is the same for all wavelengths of a path, whichever is
// its hero.
bool parts_aside(const Tracing& tracing, const Traveller& t, Point3d p, const SampledSpectrum& eta,
                 double thickness, double outside);

}  // namespace vitrail
