// SPDX-License-Identifier: Apache-2.0
// RGB → sigmoids for the texels of images, by interpolation in a table, as Jakob & Hanika (2019) do.
#pragma once

#include <array>
#include <optional>

#include "bundle/texel.h"

namespace vitrail {

// Three charts, one for each greatest component α. Their coordinates are α and the ratios ρ of the other two
// to it, spaced evenly in w = r/(1 + r) with r = √(α/(1 − α)), and in √ρ. A vertex holds √(α(1 − α))·x at
// 360, 595 and 830 nm, and its slopes. Cells interpolate with cubics (Hermite's, without mixed derivatives).
//
// S differs from that of reflectance_from_rgb by less than 5e-4, and by 5e-6 in the mean: a cell is only used
// where it agrees with fits at five places within `trusted_difference`. Bright colours are looked up by
// their complement: 1 − S has the colour 1 − c, and −x. Cells very near black, white and some edges of the
// gamut are not used.
//
// Vertices and cells are made when they are first asked for, once in a process. What they hold depends on
// nothing, so that the result is a pure function of the colour, the same on every machine and for any number
// of threads. Safe to use from many threads.
class ReflectanceTable {
 public:
  ReflectanceTable();

  // Linear sRGB. Nothing for greys, for what is outside [0,1], and where the table is not close enough: those
  // colours are to be fitted.
  std::optional<SigmoidNodes> operator()(const std::array<float, 3>& color) const;
  // The same of four at once, in less time.
  std::array<std::optional<SigmoidNodes>, 4> of_four(const std::array<std::array<float, 3>, 4>& colors) const;

  static constexpr double trusted_difference = 1e-4;  // of S

 private:
  struct Charts;
  Charts& charts_;
};

}  // namespace vitrail
