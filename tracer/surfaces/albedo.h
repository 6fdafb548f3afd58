// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tracer/surfaces/scattering.h"

namespace vitrail {

// The share of the light from `out`, as `sample` takes it, that is scattered to either side: the
// directional-hemispherical reflectance, and of what transmits, transmittance beside it. Of power: clear
// glass has 1, from within too, so what `sample` multiplies by 1/η² is divided by it. In closed form where
// that is known, else a mean of 16 samples that is unbiased over `random`.
SampledSpectrum albedo(const Bsdf& bsdf, Vector3d out, std::uint64_t random);

}  // namespace vitrail
