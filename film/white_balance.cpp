// SPDX-License-Identifier: Apache-2.0
#include "film/white_balance.h"

#include <array>

namespace vitrail {

namespace {

using Column = std::array<double, 3>;
using Matrix = std::array<Column, 3>;

Column product(const Matrix& m, const Column& v) {
  Column result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result[i] += m[i][k] * v[k];
  return result;
}

// From XYZ to the responses of cones, and back (Lam 1985; ICC.1:2022, annex E).
constexpr Matrix to_cones{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
constexpr Matrix from_cones{{{0.986992905466712, -0.147054256420990, 0.159962651663731},
                             {0.432305269723395, 0.518360271536777, 0.049291228212855},
                             {-0.008528664575178, 0.040042821654085, 0.968486695787550}}};

Column cones(XYZ c) { return product(to_cones, {c.x, c.y, c.z}); }

}  // namespace

Chromaticity daylight(double kelvin) {
  const double t = kelvin * (1.4388 / 1.4380);
  if (!(t >= 4000)) {
    const XYZ c = to_xyz(blackbody(t));
    const double sum = c.x + c.y + c.z;
    return {c.x / sum, c.y / sum};
  }
  const double k = 1e3 / t;
  const double x = t <= 7000 ? ((-4.6070 * k + 2.9678) * k + 0.09911) * k + 0.244063
                             : ((-2.0064 * k + 1.9018) * k + 0.24748) * k + 0.237040;
  return {x, (-3 * x + 2.870) * x - 0.275};
}

void balance_white(Picture& picture, double kelvin) {
  const Chromaticity white = daylight(kelvin);
  const Column from = cones({white.x / white.y, 1, (1 - white.x - white.y) / white.y}),
               to = cones(srgb_to_xyz({1, 1, 1}));
  for (std::size_t pixel = 0; pixel < picture.rgb.pixels(); ++pixel) {
    float* const v = &picture.rgb.values[3 * pixel];
    const XYZ seen =
        srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])});
    Column response = cones(seen);
    for (std::size_t i = 0; i < 3; ++i) response[i] *= to[i] / from[i];
    const Column shown = product(from_cones, response);
    const RGB c = xyz_to_srgb({shown[0], shown[1], shown[2]});
    v[0] = static_cast<float>(c.r), v[1] = static_cast<float>(c.g), v[2] = static_cast<float>(c.b);
    if (picture.variance.values.empty() || !(seen.y > 0)) continue;
    const double gain = shown[1] / seen.y;
    picture.variance.values[pixel] =
        static_cast<float>(gain * gain * static_cast<double>(picture.variance.values[pixel]));
  }
}

}  // namespace vitrail
