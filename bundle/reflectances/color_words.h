// SPDX-License-Identifier: Apache-2.0
// From a colour to the texel of its reflectance.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "bundle/reflectances/reflectance_fitter.h"
#include "bundle/texel.h"

namespace vitrail {

// The texel (TexelFormat::reflectance) of linear sRGB within [0,1]: by the table, else fitted. A pure
// function.
TexelWords reflectance_words(const std::array<float, 3>& color, const ReflectanceFitter& fitter);

// The texel (TexelFormat::illuminant) of linear sRGB, finite and not negative.
TexelWords light_words(const std::array<float, 3>& color, const ReflectanceFitter& fitter);

// The colour, linear sRGB, whose spectrum is still to be found (is_color_code), of words that were read from
// a file of this format: `values` are its. Nothing where they are of a spectrum, or some of them.
std::optional<std::array<float, 3>> coded_color(TexelFormat of_file, const TexelWords& words,
                                                std::span<const float> values);

// The texel that the words of a colour stand for.
TexelWords found_words(TexelFormat of_file, const TexelWords& words, std::span<const float> values,
                       const ReflectanceFitter& fitter);

// The memory that the table and the grid of fits may take.
inline constexpr std::uint64_t conversion_bytes = 9 << 20;

}  // namespace vitrail
