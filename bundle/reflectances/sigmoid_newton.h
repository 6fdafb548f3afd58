// SPDX-License-Identifier: Apache-2.0
// This file has Newton's method for the sigmoid of a colour, with x at 360, 595 and 830 nm as its unknowns.
#pragma once

#include <array>
#include <optional>

#include "bundle/texel.h"

namespace vitrail {

using Column3 = std::array<double, 3>;

struct LinearisedColor {
  Column3 xyz{};                      // under D65
  std::array<Column3, 3> jacobian{};  // ∂xyz[row]/∂x[column]
};

// Returns the colour of the sigmoid through these x, summed over every nanometre.
LinearisedColor linearised_color(const Column3& x);

// Solves m·v = r by Cramer's rule; the result is not finite where m is singular.
Column3 solve(const std::array<Column3, 3>& m, const Column3& r);

// Returns the sigmoid of a colour (XYZ under D65) from a start that is near. It sums over every fifth
// nanometre, or over every one where the sigmoid is steep. It returns nothing where the steps do not converge
// at once.
std::optional<SigmoidNodes> refined_sigmoid(const Column3& start, const Column3& xyz);
// Does the same, with a last step on every nanometre.
std::optional<SigmoidNodes> finely_refined_sigmoid(const Column3& start, const Column3& xyz);

}  // namespace vitrail
