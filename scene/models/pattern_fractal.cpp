// SPDX-License-Identifier: Apache-2.0
// Fractals of the plane (POV-Ray's documentation, "Fractal patterns"); where they end, and from which z on,
// is what povray 3.7 shows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/models/pattern_formula.h"

namespace vitrail {

namespace {

struct Complex {
  double x = 0, y = 0;
};
Complex operator+(Complex a, Complex b) { return {a.x + b.x, a.y + b.y}; }
Complex operator+(Complex a, double b) { return {a.x + b, a.y}; }
Complex operator*(Complex a, Complex b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
Complex operator*(double a, Complex b) { return {a * b.x, a * b.y}; }
double norm(Complex a) { return a.x * a.x + a.y * a.y; }
Complex operator/(Complex a, Complex b) {
  return (1 / norm(b)) * Complex{a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y};
}

Complex next_of(const PatternFractal& f, Complex z, Complex c) {
  if (f.kind == PatternFractal::Kind::power) {
    Complex power = z;
    for (std::uint32_t i = 1; i < f.exponent; ++i) power = power * z;
    return power + c;
  }
  Complex ratio;
  if (f.kind == PatternFractal::Kind::magnet1) {
    ratio = (z * z + c + -1.0) / (2 * z + c + -2.0);
  } else {
    const Complex c1 = c + -1.0, c2 = c + -2.0, product = c1 * c2;
    ratio = (z * z * z + 3 * (c1 * z) + product) / (3 * (z * z) + 3 * (c2 * z) + product + 1.0);
  }
  return ratio * ratio;
}

}  // namespace

double fractal_value(const PatternFractal& f, double x, double y) {
  using Color = PatternFractal::Color;
  constexpr double far = 1e4, near = 1e-4;  // squares, of magnets
  const bool is_power = f.kind == PatternFractal::Kind::power;
  const Complex p{x, y}, c = f.is_julia ? Complex{f.seed[0], f.seed[1]} : p;
  Complex z = is_power || f.is_julia ? p : Complex{};
  constexpr double none = std::numeric_limits<double>::infinity();
  double least = is_power || f.is_julia ? norm(p) : none;  // povray leaves z = 0 out
  std::uint32_t steps = 0;
  bool outside = false;
  for (; steps < f.iterations; ++steps) {
    z = next_of(f, z, c);
    const double size = norm(z);
    outside = is_power ? size > 4 : size > far || norm(z + -1.0) < near;
    if (outside) break;
    least = std::min(least, size);
  }
  const double factor = outside ? f.outside_factor : f.inside_factor;
  switch (outside ? f.outside : f.inside) {
    case Color::constant:
      return factor;
    case Color::steps:
      return outside ? static_cast<double>(steps) / f.iterations : std::sqrt(least) * factor;
    case Color::real:
      return z.x * factor;
    case Color::imaginary:
      return z.y * factor;
    case Color::real2:
      return z.x * z.x * factor;
    case Color::imaginary2:
      return z.y * z.y * factor;
    case Color::modulus:
      return outside ? std::sqrt(norm(z)) * factor : z.x * z.x + z.y * z.y * factor;
  }
  return 0;
}

}  // namespace vitrail
