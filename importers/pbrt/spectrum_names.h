// SPDX-License-Identifier: Apache-2.0
// What pbrt knows by name beyond scene/named_spectra.h.
#pragma once

#include <optional>
#include <string_view>

#include "scene/color.h"

namespace vitrail::pbrt {

// The correlated colour temperature in K of an illuminant, of which no spectrum is at hand.
std::optional<double> illuminant_temperature(std::string_view name);

// Linear sRGB reflectance at normal incidence of metals without a table, by the name of either of their
// spectra: "metal-CuZn-eta".
std::optional<RGB> metal_reflectance(std::string_view name);

}  // namespace vitrail::pbrt
