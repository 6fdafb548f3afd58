// SPDX-License-Identifier: Apache-2.0
// These are media that have been measured, by the names that pbrt and Mitsuba 0.6 know them by ("Skin1").
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/records/medium.h"

namespace vitrail {

// Returns the coefficients of a medium per mm. The scattering is the reduced one, σ_s(1 − g), that goes with
// an isotropic phase function. The 12 first are of Jensen et al., "A Practical Model for Subsurface Light
// Transport" (2001), the others of Narasimhan et al., "Acquiring Scattering Properties of Participating Media
// by Dilution" (2006). Both measured three colours, which are linear sRGB here as they are to pbrt. It
// returns nothing where the name is unknown.
std::optional<AbsorptionScattering> measured_medium(std::string_view name);

// Returns the index of refraction that Jensen et al. give for it, or water's; 1.33 where the name is unknown.
double measured_medium_eta(std::string_view name);

// Returns all of their names.
std::vector<std::string> measured_media();

}  // namespace vitrail
