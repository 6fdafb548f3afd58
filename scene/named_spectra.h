// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "scene/spectrum.h"

namespace vitrail {

// Spectra that scene files refer to by name: "stdillum-D65", "glass-BK7" and its aliases. Empty when unknown.
std::optional<Spectrum> named_spectrum(const std::string& name);

// Schott N-BK7, n(λ) by the Sellmeier coefficients of its data sheet.
SellmeierSpectrum bk7();

}  // namespace vitrail
