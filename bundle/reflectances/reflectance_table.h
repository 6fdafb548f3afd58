// SPDX-License-Identifier: Apache-2.0
// This table turns RGB into sigmoids for the texels of images, by interpolation, as Jakob & Hanika (2019) do.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "bundle/texel.h"

namespace vitrail {

// The table has three charts, one for each greatest component α. Their coordinates are α and the ratios ρ of
// the other two to it, spaced evenly in w = r/(1 + r) with r = √(α/(1 − α)), and in √ρ. A vertex holds
// √(α(1 − α))·x at 360, 595 and 830 nm, and its slopes. Cells interpolate with cubics (Hermite's, without
// mixed derivatives).
//
// S differs from that of reflectance_from_rgb by less than 5e-4, and by 5e-6 in the mean: a cell is only used
// where it agrees with fits at five places within `ReflectanceChart::trusted_difference`. Bright colours are
// looked up by their complement: 1 − S has the colour 1 − c, and −x. Cells very near black, white and some
// edges of the gamut are not used.
//
// The table is made while the project is built (make_reflectance_table.cpp), and takes 5 MB of the programs
// that bake images.

// `color` is linear sRGB. Returns nothing for greys, for colours outside [0,1], and where the table is not
// close enough: those colours have to be fitted.
std::optional<SigmoidNodes> tabulated_reflectance(const std::array<float, 3>& color);
// Does the same for several colours, at most reflectance_batch, in less time.
inline constexpr std::size_t reflectance_batch = 64;
void tabulated_reflectances(std::span<const std::array<float, 3>> colors,
                            std::span<std::optional<SigmoidNodes>> nodes);

}  // namespace vitrail
