// SPDX-License-Identifier: Apache-2.0
#include "glazing/color_rendering.h"

#include <array>
#include <cmath>

#include "glazing/evaluation.h"
#include "glazing/standard_tables.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

using Xyz = std::array<double, 3>;

struct Uv {  // CIE 1960
  double u = 0, v = 0;
};

Uv uv_of(const Xyz& xyz) {
  const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
  return {4 * xyz[0] / sum, 6 * xyz[1] / sum};
}

// CIE 13.3, equation (2).
double c_of(const Uv& at) { return (4 - at.u - 10 * at.v) / at.v; }
double d_of(const Uv& at) { return (1.708 * at.v + 0.404 - 1.481 * at.u) / at.v; }

// The white, then the test colours, as light of `power` shows them.
std::array<Xyz, 9> seen_by(const std::array<double, 81>& power) {
  std::array<Xyz, 9> seen{};
  for (std::size_t i = 0; i < power.size(); ++i) {
    const auto& observer = cie_1931()[20 + 5 * i];  // from 360 nm, each 1 nm
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t color = 0; color < 9; ++color)
        seen[color][c] += power[i] * static_cast<double>(observer[c]) *
                          (color == 0 ? 1 : cie_test_colors_5nm()[i][color - 1]);
  }
  const double white = seen[0][1];
  for (Xyz& xyz : seen)
    for (double& value : xyz) value *= 100 / white;
  return seen;
}

// W*, U*, V* against the reference's white (equation (5)).
Xyz wuv(double luminance, const Uv& at, const Uv& white) {
  const double w = 25 * std::cbrt(luminance) - 17;
  return {w, 13 * w * (at.u - white.u), 13 * w * (at.v - white.v)};
}

}  // namespace

std::optional<double> color_rendering_index(const SystemSpectrum& spectrum) {
  std::array<double, 81> d65{}, through{};
  double light = 0;
  for (std::size_t i = 0; i < d65.size(); ++i) {
    const double nm = 380 + 5 * static_cast<double>(i);
    d65[i] = cie_d65_5nm()[16 + i];  // from 300 nm
    through[i] = d65[i] * value_at(spectrum, nm).t;
    light += through[i];
  }
  if (!(light > 0)) return {};
  const std::array<Xyz, 9> reference = seen_by(d65), test = seen_by(through);
  const Uv white = uv_of(reference[0]), tested_white = uv_of(test[0]);
  double sum = 0;
  for (std::size_t color = 1; color < 9; ++color) {
    const Uv seen = uv_of(test[color]);
    const double c = c_of(white) / c_of(tested_white) * c_of(seen),
                 d = d_of(white) / d_of(tested_white) * d_of(seen);
    const double all = 16.518 + 1.481 * c - d;
    const Uv adapted{(10.872 + 0.404 * c - 4 * d) / all, 5.520 / all};  // equation (3)
    const Xyz a = wuv(test[color][1], adapted, white),
              b = wuv(reference[color][1], uv_of(reference[color]), white);
    sum += 100 - 4.6 * std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  return sum / 8;
}

}  // namespace vitrail
