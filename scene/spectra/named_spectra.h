// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/spectra/spectrum.h"

namespace vitrail {

// Returns the values of a spectrum that scene files refer to by name, never a NamedSpectrum: CIE illuminants
// of luminance 1 ("stdillum-D65", -A, -D50, -E, -F1 … -F12, "illum-acesD60"), glasses ("glass-BK7" and its
// aliases), and the index of refraction of metals ("metal-Cu-eta", "metal-Cu-k", any of metal_tables). It
// returns nothing when the name is unknown.
std::optional<Spectrum> named_spectrum(const std::string& name);

// Returns all names that named_spectrum knows, sorted.
std::vector<std::string> spectrum_names();

// Returns Schott N-BK7, n(λ) by the Sellmeier coefficients of its data sheet.
SellmeierSpectrum bk7();

}  // namespace vitrail
