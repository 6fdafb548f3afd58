// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace vitrail {

// A patch has measured reflectance at 380, 390 … 780 nm.
struct ColorCheckerPatch {
  std::string_view name;
  std::array<double, 41> reflectance;
};

// Returns the 24 patches of the Macbeth ColorChecker: Ohta, "The basis of color reproduction engineering"
// (1997), which are those of ISO 17321-1.
std::span<const ColorCheckerPatch> color_checker();

}  // namespace vitrail
