// SPDX-License-Identifier: Apache-2.0
// These are tristimulus colours. XYZ are normalised by ∫ȳ: a pixel that sees radiance S has Y = ∫ S ȳ dλ / ∫
// ȳ dλ.
#pragma once

#include <array>

#include "scene/spectra/spectrum.h"

namespace vitrail {

// It holds CIE 1931 tristimulus values.
struct XYZ {
  double x = 0, y = 0, z = 0;
  bool operator==(const XYZ&) const = default;
};

// It is linear, with the primaries of a colour space.
struct RGB {
  double r = 0, g = 0, b = 0;
  bool operator==(const RGB&) const = default;
};

// They convert linear sRGB (Rec. 709 primaries, D65) to XYZ and back; the two are inverse to rounding.
XYZ srgb_to_xyz(RGB c);
RGB xyz_to_srgb(XYZ c);

// Returns the linear sRGB coordinates of a colour given in another space: "srgb", "rec2020", "dci-p3",
// "aces2065-1". White maps to white. Unknown names throw Error.
RGB to_srgb(RGB c, const char* color_space);

// It is a point of the CIE 1931 xy plane where a primary or the white of a colour space lies.
struct Chromaticity {
  double x = 0, y = 0;
  bool operator==(const Chromaticity&) const = default;
};
// They are those of a colour space.
struct Chromaticities {
  Chromaticity red, green, blue, white;
};
// Returns the name of the space that these are of, to a thousandth; nullptr where `to_srgb` knows none.
const char* color_space_of(const Chromaticities& c);
// Returns red, green and blue of (such) a space in linear sRGB, white with luminance 1: the same colours, not
// adapted to another white.
std::array<RGB, 3> primaries_in_srgb(const Chromaticities& c);

// They are the sRGB transfer function, linear ⇄ encoded, both in [0,1].
double srgb_encode(double linear);
double srgb_decode(double encoded);

// Returns ∫ S(λ) (x̄, ȳ, z̄)(λ) dλ / ∫ ȳ dλ, of an emission.
XYZ to_xyz(const Spectrum& emission);

// They are the CIE 1931 2° observer x̄, ȳ, z̄ at 360, 361 … 830 nm, and ∫ȳ dλ over that grid in nm.
const std::array<std::array<float, 3>, table_size>& cie_1931();
inline constexpr double cie_y_integral_nm = 106.856895;
// Returns CIE D65 on the same grid, normalised to ∫ S ȳ dλ / ∫ ȳ dλ = 1.
const std::array<float, table_size>& cie_d65();

}  // namespace vitrail
