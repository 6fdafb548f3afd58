// SPDX-License-Identifier: Apache-2.0
// Textures that shine are times D65 (scene/records/texture.h). Those that are not, as Mitsuba's, are products
// with its inverse.
#pragma once

#include <optional>

#include "scene/spectra/spectrum.h"

namespace vitrail {

// Returns 1/D65(λ), with D65 normalised as cie_d65 (scene/spectra/color.h).
TabulatedSpectrum inverse_d65();

// Returns f where the spectrum is f/D65, to float precision; nothing otherwise.
std::optional<double> multiple_of_inverse_d65(const Spectrum& spectrum);

}  // namespace vitrail
