// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/pbrt/read/textures.h"
#include "scene/records/scene.h"
#include "scene/spectra/color.h"

namespace vitrail::pbrt {

// It is the light that the colour (1, 1, 1) in an rgbgrid's Le stands for: alone among what shines in
// pbrt-v4, it is not divided by the luminance of its illuminant, ∫ȳ.
inline constexpr RGB white_of_rgb_grids{cie_y_integral_nm, cie_y_integral_nm, cie_y_integral_nm};

// Makes the medium of a MakeNamedMedium directive of type `kind`.
Medium make_medium(const std::string& kind, const std::string& name, ParameterSet& parameters,
                   const Transform& ctm, const Scope& scope);

}  // namespace vitrail::pbrt
