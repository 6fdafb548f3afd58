// SPDX-License-Identifier: Apache-2.0
// This file has the layout of the table behind reflectance_table.h, and how its cells interpolate. The
// program that makes the table and the code that reads it share it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace vitrail {

// It holds values at three wavelengths: 360, 595 and 830 nm.
using Float4 = float __attribute__((vector_size(16)));

// A vertex holds √(α(1 − α))·x.
struct alignas(64) ReflectanceVertex {
  Float4 value{};                  // the last: 1 if the cell that begins here agrees with fits, else 0
  std::array<Float4, 3> slopes{};  // by the coordinates, over the width of a cell; the last is not used
};

// There are three charts. The vertices of one are ordered by α, by the first ratio, and by the second.
struct ReflectanceChart {
  static constexpr int count = 3, alpha_cells = 24, ratio_cells = 32;
  static constexpr int along_ratio = ratio_cells + 1, along_alpha = along_ratio * along_ratio;
  static constexpr std::size_t vertex_count = std::size_t{count} * (alpha_cells + 1) * along_alpha;
  static constexpr float least_alpha = 1e-5f, greatest_alpha = 1 - 1e-5f;
  static constexpr double cell_root = 1.0 / ratio_cells;  // the width of a cell, in √ρ

  static constexpr double trusted_difference = 1e-4;  // of S, in cells that are used

  // Returns w of α.
  static double warp(double alpha) {
    const double r = std::sqrt(alpha / (1 - alpha));
    return r / (1 + r);
  }
  static inline const double first_w = warp(static_cast<double>(least_alpha));
  static inline const double cell_w = (warp(static_cast<double>(greatest_alpha)) - first_w) / alpha_cells;
};

// A ReflectancePlace is a place in a chart.
struct ReflectancePlace {
  int chart = 0;
  std::array<int, 3> cell{};
  std::array<float, 3> part{};  // of the cell, within [0,1]
  float unscale = 0;            // 1/√(α(1 − α))

  // Returns the index of the cell, which is also that of its first vertex.
  std::size_t index() const {
    using C = ReflectanceChart;
    return static_cast<std::size_t>(
        ((chart * (C::alpha_cells + 1) + cell[0]) * C::along_ratio + cell[1]) * C::along_ratio + cell[2]);
  }
};

// Returns x from the vertices of a cell, of which `first` is the first: it sums values and slopes. At the
// distance d along an axis a cubic with given ends is u·(1 + d·(u − d))·value + u·d·u·slope, u = 1 − d.
inline Float4 interpolated(const ReflectanceVertex* first, const ReflectancePlace& place) {
  std::array<std::array<float, 2>, 3> weight, bend, lean;
  for (std::size_t k = 0; k < 3; ++k) {
    const float f = place.part[k], g = 1 - f, both = f * g;
    weight[k] = {g, f};
    bend[k] = {f * (g - f), g * (f - g)};
    lean[k] = {both, -both};
  }
  // They give the factors of the four corners of a side.
  const auto along_b = [](const std::array<float, 2>& v) { return Float4{v[0], v[0], v[1], v[1]}; };
  const auto along_c = [](const std::array<float, 2>& v) { return Float4{v[0], v[1], v[0], v[1]}; };
  Float4 sum{};
  for (std::size_t a = 0; a < 2; ++a) {
    const Float4 all = weight[0][a] * along_b(weight[1]) * along_c(weight[2]);
    const Float4 straight = all * (1 + bend[0][a] + along_b(bend[1]) + along_c(bend[2]));
    const Float4 s0 = all * lean[0][a], s1 = all * along_b(lean[1]), s2 = all * along_c(lean[2]);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const ReflectanceVertex& v = first[a * ReflectanceChart::along_alpha +
                                         (corner >> 1) * ReflectanceChart::along_ratio + (corner & 1)];
      sum += v.value * straight[corner] + v.slopes[0] * s0[corner] +
             (v.slopes[1] * s1[corner] + v.slopes[2] * s2[corner]);
    }
  }
  return sum * place.unscale;
}

}  // namespace vitrail
