// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail::pov {

// Gradient noise (Perlin 2002) with a lattice of our own, from 0 to 1, of mean ½: f_noise3d() in formulas.
// POV-Ray's has bumps in other places.
double noise(double x, double y, double z);

inline constexpr const char* noise_elsewhere =
    "noise: of the same statistics as POV-Ray's, and in other places";

}  // namespace vitrail::pov
