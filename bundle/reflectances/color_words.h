// SPDX-License-Identifier: Apache-2.0
// These functions turn a colour into the texel of its reflectance.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "bundle/reflectances/reflectance_fitter.h"
#include "bundle/texel.h"

namespace vitrail {

// Returns the texel (TexelFormat::reflectance) of linear sRGB within [0,1]: by the table, else fitted. It is
// a pure function.
TexelWords reflectance_words(const std::array<float, 3>& color, const ReflectanceFitter& fitter);

// Returns the texel (TexelFormat::illuminant) of linear sRGB, finite and not negative.
TexelWords light_words(const std::array<float, 3>& color, const ReflectanceFitter& fitter);

// Returns the colour, in linear sRGB, whose spectrum is still to be found (is_color_code). `words` were read
// from a file of this format, whose code values are `values`. It returns nothing where they hold a spectrum,
// whole or in part.
std::optional<std::array<float, 3>> coded_color(TexelFormat of_file, const TexelWords& words,
                                                std::span<const float> values);

// Returns the texel that the words of a colour stand for.
TexelWords found_words(TexelFormat of_file, const TexelWords& words, std::span<const float> values,
                       const ReflectanceFitter& fitter);

// It is the memory that the table and the grid of fits may take.
inline constexpr std::uint64_t conversion_bytes = 9 << 20;

}  // namespace vitrail
