// SPDX-License-Identifier: Apache-2.0
// This is the phase function of Henyey and Greenstein (1941), g in (−1, 1). It is p(cos θ) = (1 − g²)/(4π
// (1 + g² − 2g cos θ)^{3/2}), θ the angle by which light is turned.
#pragma once

#include "scene/geometry/vec.h"

namespace vitrail {

// Returns the phase function in sr⁻¹, which is also the pdf of sample_phase. `out` and `in` point away from
// the point: cos θ = −out·in.
double phase(double g, Vector3d out, Vector3d in);

// Returns `in` for a uniform (u, v) in [0,1)².
Vector3d sample_phase(double g, Vector3d out, float u, float v);

}  // namespace vitrail
