// SPDX-License-Identifier: Apache-2.0
// From a colour to the texel of its reflectance.
#pragma once

#include <array>
#include <span>

#include "bundle/reflectances/reflectance_fitter.h"
#include "bundle/texel.h"

namespace vitrail {

// The texel (TexelFormat::reflectance) of linear sRGB within [0,1]: by the table, else fitted. A pure
// function.
TexelWords reflectance_words(const std::array<float, 3>& color, const ReflectanceFitter& fitter);

// The same of the colour that a word of codes stands for (is_color_code).
TexelWords color_words(std::uint32_t word, std::span<const float> values, const ReflectanceFitter& fitter);

// The memory that the table and the grid of fits may take.
inline constexpr std::uint64_t conversion_bytes = 9 << 20;

}  // namespace vitrail
