// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "importers/solids/fractal.h"
#include "importers/solids/implicit.h"
#include "scene/geometry/portable_math.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

using Number = std::array<double, 4>;

Number product(const Number& a, const Number& b, bool hypercomplex) {
  const auto& [x, y, z, w] = a;
  const auto& [p, q, r, s] = b;
  if (hypercomplex)  // i² = j² = −1, k = ij, all commute
    return {x * p - y * q - z * r + w * s, x * q + y * p - z * s - w * r, x * r + z * p - y * s - w * q,
            x * s + w * p + y * r + z * q};
  return {x * p - y * q - z * r - w * s, x * q + y * p + z * s - w * r, x * r - y * s + z * p + w * q,
          x * s + y * r - z * q + w * p};
}

double square(const Number& h) { return h[0] * h[0] + h[1] * h[1] + h[2] * h[2] + h[3] * h[3]; }

// log(|h after all steps| ÷ 4): where h has become so large that the parameter no longer counts, each step
// that is left multiplies its logarithm by the function's power.
double field(const JuliaFractal& f, Number h) {
  const int power = f.function == JuliaFractal::Function::cube ? 3 : 2;
  const int steps = f.hypercomplex ? f.max_iteration - 1 : f.max_iteration;
  constexpr double large = 1e16;
  for (int i = 0; i < steps; ++i) {
    Number next = product(h, h, f.hypercomplex);
    if (power == 3) next = product(next, h, f.hypercomplex);
    for (std::size_t k = 0; k < 4; ++k) h[k] = next[k] + f.parameter[k];
    if (const double size = square(h); size > large)
      return portable_log(size / 16) / 2 * portable_pow(power, steps - 1 - i);
  }
  const double size = square(h);
  return size > 0 ? portable_log(size / 16) / 2 : -1e3;
}

}  // namespace

Solid julia_fractal(const JuliaFractal& fractal, const Tessellation& tessellation) {
  const auto& n = fractal.slice_normal;
  if (n[3] == 0 || !std::isfinite(n[3])) throw Error("the fourth number of a julia_fractal's slice is 0");
  return implicit({.field =
                       [&](const Point3d& p) {
                         const double w =
                             (fractal.slice_distance - n[0] * p.x - n[1] * p.y - n[2] * p.z) / n[3];
                         return field(fractal, {p.x, p.y, p.z, w});
                       },
                   .container = ContainingSphere{{0, 0, 0}, 2},
                   .cells = 80,
                   .most_halvings = 1},
                  tessellation);
}

}  // namespace vitrail::solids
