// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/rgb_to_spectrum.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace vitrail {

namespace {

using Column3 = std::array<double, 3>;
using Matrix3 = std::array<Column3, 3>;

// The solver's polynomial is in t = (λ − 360 nm)/470 nm ∈ [0,1], which keeps its three coefficients of one
// magnitude: x(t) = p₀t² + p₁t + p₂.
constexpr double lambda_range_nm = lambda_max_nm - lambda_min_nm;

// Added up side by side, each in its own order.
using Pair = double __attribute__((vector_size(16)));

// D65·(x̄, ȳ, z̄)/∫ȳ at 1 nm: the XYZ of a reflectance under D65 is its sum with these.
struct Weights {
  Pair xy;
  double z;
};
const std::array<Weights, table_size>& weights() {
  static const auto table = [] {
    std::array<Weights, table_size> all;
    for (std::size_t i = 0; i < table_size; ++i) {
      const auto weight = [i](std::size_t k) {
        return static_cast<double>(cie_d65()[i]) * static_cast<double>(cie_1931()[i][k]) / cie_y_integral_nm;
      };
      all[i] = Weights{Pair{weight(0), weight(1)}, weight(2)};
    }
    return all;
  }();
  return table;
}

// t of every nm.
const std::array<double, table_size>& places() {
  static const auto table = [] {
    std::array<double, table_size> t;
    for (std::size_t i = 0; i < table_size; ++i) t[i] = static_cast<double>(i) / lambda_range_nm;
    return t;
  }();
  return table;
}

Column3 to_column(XYZ c) { return {c.x, c.y, c.z}; }

struct Lab {
  Column3 value;
  Column3 slope;  // of f at X/Xₙ, Y/Yₙ, Z/Zₙ, divided by Xₙ, Yₙ, Zₙ
};

// CIELAB relative to D65 (CIE 15:2018, 8.2.1): L = 116 f(Y) − 16, a = 500(f(X) − f(Y)), b = 200(f(Y) − f(Z)).
Lab to_lab(const Column3& xyz) {
  static const Column3 white = to_column(srgb_to_xyz({1, 1, 1}));
  constexpr double delta = 6.0 / 29;
  Column3 f, slope;
  for (std::size_t k = 0; k < 3; ++k) {
    const double t = xyz[k] / white[k];
    const bool dark = t <= delta * delta * delta;
    f[k] = dark ? t / (3 * delta * delta) + 4.0 / 29 : std::cbrt(t);
    slope[k] = (dark ? 1 / (3 * delta * delta) : 1 / (3 * f[k] * f[k])) / white[k];
  }
  return {{116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])}, slope};
}

// The distance ΔE*ab (1976) of two colours.
double distance(const Column3& a, const Column3& b) {
  const double l = a[0] - b[0], m = a[1] - b[1], n = a[2] - b[2];
  return std::sqrt(l * l + m * m + n * n);
}

struct Linearised {
  Column3 lab;
  Matrix3 jacobian;  // ∂Lab/∂p, [row of Lab][column of p]
};

// Two loops, of which the first has the √ and ÷ and no sums, which would keep it from being vectorised.
Linearised linearise(const Column3& p) {
  std::array<double, table_size> s, slope;
  const std::array<double, table_size>& t = places();
  const double p0 = p[0], p1 = p[1], p2 = p[2];
  for (std::size_t i = 0; i < table_size; ++i) {
    const double x = (p0 * t[i] + p1) * t[i] + p2;
    const double y = 1 / std::sqrt(1 + x * x);
    s[i] = 0.5 + 0.5 * x * y;
    slope[i] = 0.5 * y * y * y;
  }
  Pair xy{}, xy0{}, xy1{}, xy2{};
  double z = 0, z0 = 0, z1 = 0, z2 = 0;
  for (std::size_t i = 0; i < table_size; ++i) {
    const Weights& w = weights()[i];
    const Pair at{t[i], t[i]}, xy_slope = w.xy * Pair{slope[i], slope[i]}, xy_t = xy_slope * at;
    const double z_slope = w.z * slope[i], z_t = z_slope * t[i];
    xy += w.xy * Pair{s[i], s[i]}, z += w.z * s[i];
    xy2 += xy_slope, z2 += z_slope;
    xy1 += xy_t, z1 += z_t;
    xy0 += xy_t * at, z0 += z_t * t[i];
  }
  const Lab lab = to_lab({xy[0], xy[1], z});
  const Matrix3 d{{{xy0[0], xy0[1], z0}, {xy1[0], xy1[1], z1}, {xy2[0], xy2[1], z2}}};
  Linearised result{lab.value, {}};
  for (std::size_t j = 0; j < 3; ++j) {
    const double fx = lab.slope[0] * d[j][0], fy = lab.slope[1] * d[j][1], fz = lab.slope[2] * d[j][2];
    result.jacobian[0][j] = 116 * fy;
    result.jacobian[1][j] = 500 * (fx - fy);
    result.jacobian[2][j] = 200 * (fy - fz);
  }
  return result;
}

// Solves m·v = r by Cramer's rule; the components are not finite where m is singular.
Column3 solve(const Matrix3& m, const Column3& r) {
  const auto det = [](const Matrix3& a) {
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
           a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  };
  const double d = det(m);
  Column3 v;
  for (std::size_t j = 0; j < 3; ++j) {
    Matrix3 replaced = m;
    for (std::size_t i = 0; i < 3; ++i) replaced[i][j] = r[i];
    v[j] = det(replaced) / d;
  }
  return v;
}

struct Fit {
  Column3 p;
  double error;  // ΔE*ab
};

constexpr double tolerance = 1e-7;  // ΔE*ab

// Gauss–Newton, with steps halved steps where the error would grow.
Fit fit(Column3 p, const Column3& target_lab) {
  Linearised at = linearise(p);
  double error = distance(at.lab, target_lab);
  for (int iteration = 0; iteration < 20 && error > tolerance; ++iteration) {
    const Column3 residual{target_lab[0] - at.lab[0], target_lab[1] - at.lab[1], target_lab[2] - at.lab[2]};
    const Column3 step = solve(at.jacobian, residual);
    bool improved = false;
    for (double length = 1; length > 1e-2 && !improved; length /= 2) {
      const Column3 q{p[0] + length * step[0], p[1] + length * step[1], p[2] + length * step[2]};
      const Linearised there = linearise(q);
      const double new_error = distance(there.lab, target_lab);
      if (!(new_error < error)) continue;
      p = q, at = there, error = new_error, improved = true;
    }
    if (!improved) break;
  }
  return {p, error};
}

// x of the constant reflectance v: the inverse of ½ + x/(2√(1+x²)).
double constant_coefficient(double v) { return (v - 0.5) / std::sqrt(v * (1 - v)); }

// Walks from the grey of equal luminance to the colour, in one step where that converges: almost everywhere.
// Newton's method stalls on the way to some dark saturated colours, and then each point starts from the
// solution before it.
Fit fit_by_continuation(RGB c) {
  const double grey = std::clamp(srgb_to_xyz(c).y, 1e-12, 1 - 1e-12);
  const auto fit_at = [&](const Column3& start, double s) {
    const RGB toward{grey + s * (c.r - grey), grey + s * (c.g - grey), grey + s * (c.b - grey)};
    return fit(start, to_lab(to_column(srgb_to_xyz(toward))).value);
  };
  Column3 p{0, 0, constant_coefficient(grey)};
  double reached = 0;
  for (double step = 1; step > 1e-3;) {
    const double s = std::min(1.0, reached + step);
    const Fit next = fit_at(p, s);
    if (next.error > tolerance) {
      step /= 2;
      continue;
    }
    if (s == 1) return next;
    p = next.p;
    reached = s;
  }
  return fit_at(p, 1);  // as near as the walk comes
}

// p(t) with t = (λ − 360)/470 as a polynomial in λ.
SigmoidSpectrum in_nm(const Column3& p) {
  const double a = p[0] / (lambda_range_nm * lambda_range_nm), b = p[1] / lambda_range_nm;
  return {static_cast<float>(a), static_cast<float>(b - 2 * a * lambda_min_nm),
          static_cast<float>((a * lambda_min_nm - b) * lambda_min_nm + p[2])};
}

SigmoidSpectrum constant_reflectance(double v) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (v <= 0) return {0, 0, -infinity};
  if (v >= 1) return {0, 0, infinity};
  return {0, 0, static_cast<float>(constant_coefficient(v))};
}

}  // namespace

namespace {

// Colours are kept as floats: what is fitted is the colour that is kept.
RGB to_color(const std::array<float, 3>& c) { return {c[0], c[1], c[2]}; }

std::array<float, 3> at_least_zero(RGB c) {
  const auto component = [](double v) { return static_cast<float>(std::max(v, 0.0)); };
  return {component(c.r), component(c.g), component(c.b)};
}

template <class Scaled>
Scaled scaled_reflectance(RGB c) {
  const std::array<float, 3> rgb = at_least_zero(c);
  c = to_color(rgb);
  const double scale = 2 * std::max({c.r, c.g, c.b});
  if (!(scale > 0)) return {};
  return {reflectance_from_rgb({c.r / scale, c.g / scale, c.b / scale}), static_cast<float>(scale), rgb};
}

}  // namespace

// Of a colour that is no grey. Scenes have the same ones again and again, and a fit takes some thousand times
// as long as to look it up: the last of each hash is kept.
static SigmoidSpectrum remembered_fit(const std::array<float, 3>& rgb) {
  constexpr std::size_t kept = 512;
  thread_local std::array<std::optional<SigmoidSpectrum>, kept> fits;
  std::size_t hash = 0;
  for (const float v : rgb) hash = (hash ^ std::bit_cast<std::uint32_t>(v)) * 0x9E3779B97F4A7C15u;
  std::optional<SigmoidSpectrum>& fit = fits[hash >> 55];  // 9 bits
  if (!fit || fit->rgb != rgb) {
    fit = in_nm(fit_by_continuation(to_color(rgb)).p);
    fit->rgb = rgb;
  }
  return *fit;
}

SigmoidSpectrum reflectance_from_rgb(RGB c) {
  std::array<float, 3> rgb = at_least_zero(c);
  for (float& v : rgb) v = std::min(v, 1.0f);
  c = to_color(rgb);
  if (c.r != c.g || c.g != c.b) return remembered_fit(rgb);
  SigmoidSpectrum fit = constant_reflectance(c.r);
  fit.rgb = rgb;
  return fit;
}

RgbIlluminantSpectrum emission_from_rgb(RGB c) { return scaled_reflectance<RgbIlluminantSpectrum>(c); }

Spectrum unbounded_from_rgb(RGB c) {
  if (std::max({c.r, c.g, c.b}) <= 1) return reflectance_from_rgb(c);
  return scaled_reflectance<RgbUnboundedSpectrum>(c);
}

}  // namespace vitrail
