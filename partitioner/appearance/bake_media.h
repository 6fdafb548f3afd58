// SPDX-License-Identifier: Apache-2.0
// This file bakes the media of a bundle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/records/medium.h"
#include "scene/spectra/rgb_method.h"

namespace vitrail {

// Returns a medium ready for rendering: spectra resolved, grids in memory, coefficients as σ_a, σ_s or σ_t,
// albedo. A grid of coloured coefficients or emission has four channels then: x of a sigmoid at 360, 595 and
// 830 nm (bundle/texel.h) and its scale. Any other grid has one. Returns none where nothing of it can be
// shown; `notes` say what stands for something else. Throws Error for files that cannot be read.
std::optional<Medium> bake_medium(const Medium& medium, RgbMethod method, std::vector<std::string>& notes);

}  // namespace vitrail
