// SPDX-License-Identifier: Apache-2.0
// ColorValues are the colour of light that a glazing lets through or reflects.
#pragma once

#include <array>
#include <optional>

namespace vitrail {

struct ColorValues {
  std::array<double, 3> xyz{};  // Y of the white is 100
  std::array<double, 3> lab{};  // CIE 1976
  std::array<int, 3> rgb{};     // sRGB of IEC 61966-2-1, on a display of 80 cd/m² that reflects 0.2 cd/m²
  // The line from the white through the colour meets the spectrum locus at dominant_nm; purity is how far the
  // colour is on it. A purple meets the line of purples: dominant_nm is then its nearer end, as in WINDOW,
  // and the complementary wavelength is given, too.
  double dominant_nm = 0, purity = 0;
  std::optional<double> complementary_nm;
};

enum class Observer { cie_1931, cie_1964 };

// Takes X, Y, Z relative to a white's (each in [0, 1]) and that white with Y = 1.
ColorValues color_values(const std::array<double, 3>& relative, const std::array<double, 3>& white,
                         Observer observer);

}  // namespace vitrail
