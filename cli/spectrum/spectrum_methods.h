// SPDX-License-Identifier: Apache-2.0
// This measures how well reflectances made from RGB stand for it, and for what was measured.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/spectra/color.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

enum class UpsamplingMethod { jakob_hanika, matrix_r };
inline constexpr UpsamplingMethod upsampling_methods[] = {UpsamplingMethod::jakob_hanika,
                                                          UpsamplingMethod::matrix_r};
const char* name_of(UpsamplingMethod method);

// It is the reflectance at 360, 365 … 830 nm, and the linear sRGB colour that it has under D65.
struct MadeReflectance {
  std::vector<double> values;
  RGB rgb;
};
MadeReflectance make_reflectance(UpsamplingMethod method, RGB c);

// A CountedColor is linear sRGB in [0, 1], and how often it occurs.
struct CountedColor {
  RGB color;
  std::size_t count = 1;
};
// Returns a grid of n³ colours over the cube, n ≥ 2.
std::vector<CountedColor> cube_colors(int n);
// Returns the pixels of a picture; their components are clamped. Throws Error.
std::vector<CountedColor> picture_colors(const std::filesystem::path& file);

struct RoundTrip {
  std::size_t colors = 0;                // different ones
  double max_error = 0, mean_error = 0;  // of a linear component; the mean is of each colour's largest
  double min_value = 1, max_value = 0;   // of a reflectance
  double roughness = 0;                  // mean over colours of the root mean square step of 5 nm
};
// Means are weighted by the counts.
RoundTrip round_trip(UpsamplingMethod method, std::span<const CountedColor> colors);

// They are a ColorChecker patch's root mean square and largest difference from what was measured, in 380–780
// nm. `color` is that between the made colour and the measured one.
struct PatchError {
  std::string name;
  double rms = 0, max = 0, color = 0;
  bool in_gamut = true;
};
std::vector<PatchError> patch_errors(UpsamplingMethod method);

// Returns measured reflectances in black, the methods' in colours, one small graph a patch.
std::string patches_svg();

}  // namespace vitrail
