// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/daylight_illuminant.h"

#include <cmath>
#include <cstddef>

#include "scene/daylight/sky_model.h"

namespace vitrail {

namespace {

// The mean and two components of measured daylights, S0, S1, S2, at the bands of the sky (CIE 15).
constexpr double components[sky_bands][3] = {
    {61.5, 38, 5.3}, {94.8, 43.4, -1.1}, {113.9, 36.7, -2.6}, {121.3, 24.3, -2.6}, {106.5, 8.6, -1.2},
    {100, 0, 0},     {90.5, -5.8, 3.2},  {85.1, -10.9, 6.7},  {81.3, -13.6, 10.2}, {63.3, -10.6, 7}};

}  // namespace

bool is_daylight(double color_temperature_k) {
  return color_temperature_k >= 4000 && color_temperature_k <= 25000;
}

double cie_daylight(double band_nm, double color_temperature_k) {
  const double t = 1000 / color_temperature_k;
  const double x = color_temperature_k <= 7000 ? 0.244063 + t * (0.09911 + t * (2.9678 - 4.6070 * t))
                                               : 0.237040 + t * (0.24748 + t * (1.9018 - 2.0064 * t));
  const double y = -3 * x * x + 2.870 * x - 0.275, m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m, m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
  const auto& s =
      components[static_cast<std::size_t>(std::lround((band_nm - first_sky_band_nm) / sky_band_step_nm))];
  return s[0] + m1 * s[1] + m2 * s[2];
}

}  // namespace vitrail
