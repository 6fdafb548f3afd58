// SPDX-License-Identifier: Apache-2.0
// This is the glow of hot media whose temperature varies from place to place.
#pragma once

namespace vitrail {

// Returns the radiance of a blackbody at a wavelength over its greatest at any: 1 at 2897.77 µm·K/T. It is 0
// at 100 K or less, as in pbrt. It follows Planck's law, with the constants of `blackbody`
// (scene/spectra/spectrum.h).
double blackbody_radiance(double kelvin, double lambda_nm);

}  // namespace vitrail
