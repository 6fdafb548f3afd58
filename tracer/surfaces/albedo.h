// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tracer/surfaces/scattering.h"

namespace vitrail {

// Returns the share of the light from `out`, as `sample` takes it, that is scattered to either side. It is
// the directional-hemispherical reflectance, with the transmittance added where light is transmitted. It is a
// share of power. Clear glass has 1, from within too: a factor 1/η² in `sample` is divided out. It is in
// closed form where that is known, else a mean of 16 samples that is unbiased over `random`.
SampledSpectrum albedo(const Bsdf& bsdf, Vector3d out, std::uint64_t random);

}  // namespace vitrail
