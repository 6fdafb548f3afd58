// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/matrix_r.h"

#include <algorithm>
#include <cmath>

#include "scene/spectra/rgb_bands.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

using Column3 = std::array<double, 3>;
using Matrix3 = std::array<Column3, 3>;

constexpr std::size_t step = 5;  // of bands on the 1 nm tables

// What reflectance i adds to X, Y, Z per 1 nm: D65·(x̄, ȳ, z̄)/∫ȳ, with D65's luminance 1.
Column3 weight_at_1nm(std::size_t i) {
  Column3 w{};
  for (std::size_t c = 0; c < 3; ++c)
    w[c] = static_cast<double>(cie_d65()[i]) * static_cast<double>(cie_1931()[i][c]) / cie_y_integral_nm;
  return w;
}

// Scales XYZ so that the constant 1 has exactly the colour (1, 1, 1): D65's printed white and that of its
// table differ in the sixth digit.
const Column3& white_scale() {
  static const Column3 scale = [] {
    Column3 sum{};
    for (std::size_t i = 0; i < table_size; ++i)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight_at_1nm(i)[c];
    const XYZ white = srgb_to_xyz({1, 1, 1});
    return Column3{white.x / sum[0], white.y / sum[1], white.z / sum[2]};
  }();
  return scale;
}

RGB rgb_of(const Column3& xyz) {
  const Column3& s = white_scale();
  return xyz_to_srgb({xyz[0] * s[0], xyz[1] * s[1], xyz[2] * s[2]});
}
Column3 tristimulus(RGB c) {
  const XYZ xyz = srgb_to_xyz(c);
  const Column3& s = white_scale();
  return {xyz.x / s[0], xyz.y / s[1], xyz.z / s[2]};
}

// A: what a band adds to X, Y, Z with all of its hat function.
const std::array<Column3, matrix_r_bands>& matrix_a() {
  static const auto a = [] {
    std::array<Column3, matrix_r_bands> sums{};
    for (std::size_t i = 0; i < table_size; ++i) {
      const Column3 w = weight_at_1nm(i);
      const std::size_t band = i / step;
      const double part = static_cast<double>(i % step) / step;
      for (std::size_t c = 0; c < 3; ++c) {
        sums[band][c] += (1 - part) * w[c];
        if (part > 0) sums[band + 1][c] += part * w[c];
      }
    }
    return sums;
  }();
  return a;
}

double dot(const Column3& a, const Column3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Cramer's rule; `m` is symmetric and positive definite.
Column3 solve(const Matrix3& m, const Column3& r) {
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double det = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Column3 x{};
  for (std::size_t i = 0; i < 3; ++i)
    x[i] = (cofactor(0, i) * r[0] + cofactor(1, i) * r[1] + cofactor(2, i) * r[2]) / det;
  return x;
}

Column3 unbounded_lambda(const Column3& t) {
  Matrix3 m{};
  for (const Column3& a : matrix_a())
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += a[i] * a[j];
  return solve(m, t);
}

// The convex function whose least value has AᵀS = T, its slope AᵀS − T and its curvature.
struct Dual {
  double value = 0;
  Column3 slope{};
  Matrix3 curvature{};
};

Dual dual_at(const Column3& lambda, const Column3& t) {
  Dual d{-dot(lambda, t), {-t[0], -t[1], -t[2]}, {}};
  for (const Column3& a : matrix_a()) {
    const double x = dot(a, lambda), s = std::clamp(x, 0.0, 1.0);
    d.value += x < 0 ? 0 : x > 1 ? x - 0.5 : x * x / 2;
    for (std::size_t i = 0; i < 3; ++i) d.slope[i] += a[i] * s;
    if (x <= 0 || x >= 1) continue;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) d.curvature[i][j] += a[i] * a[j];
  }
  return d;
}

double norm(const Column3& v) { return std::sqrt(dot(v, v)); }

Column3 bounded_lambda(const Column3& t) {
  constexpr double close = 1e-11;
  Column3 lambda = unbounded_lambda(t);
  Dual now = dual_at(lambda, t);
  double damping = 1e-12;
  for (int i = 0; i < 400 && norm(now.slope) > close; ++i) {
    Matrix3 m = now.curvature;
    for (std::size_t c = 0; c < 3; ++c) m[c][c] += damping;
    const Column3 move = solve(m, now.slope);
    const Column3 next{lambda[0] - move[0], lambda[1] - move[1], lambda[2] - move[2]};
    const Dual there = dual_at(next, t);
    // Near the least value rounding hides the descent: there the slope decides.
    const bool better = there.value < now.value || norm(there.slope) < norm(now.slope);
    damping = better ? std::max(damping / 10, 1e-15) : damping * 10;
    if (!better) continue;
    lambda = next;
    now = there;
  }
  return lambda;
}

}  // namespace

BandReflectance fundamental_metamer(RGB c) {
  const Column3 lambda = unbounded_lambda(tristimulus(c));
  BandReflectance n{};
  for (std::size_t i = 0; i < n.size(); ++i) n[i] = dot(matrix_a()[i], lambda);
  return n;
}

MatrixRReflectance matrix_r_weights(RGB c) {
  c = {std::clamp(c.r, 0.0, 1.0), std::clamp(c.g, 0.0, 1.0), std::clamp(c.b, 0.0, 1.0)};
  if (c.r == c.g && c.g == c.b) return {{}, 1 - c.r};
  // Towards white λ grows without bound: there 1 − S is a part of that of a colour farther off.
  constexpr double white_distance = 0.01;
  const double distance = 1 - std::min({c.r, c.g, c.b}), part = std::min(1.0, distance / white_distance);
  const auto farther = [&](double x) { return 1 - (1 - x) / part; };
  return {bounded_lambda(tristimulus({farther(c.r), farther(c.g), farther(c.b)})), part};
}

BandReflectance matrix_r_reflectance(RGB c) {
  const MatrixRReflectance r = matrix_r_weights(c);
  BandReflectance s{};
  for (std::size_t i = 0; i < s.size(); ++i)
    s[i] = 1 - r.part * (1 - std::clamp(dot(matrix_a()[i], r.weights), 0.0, 1.0));
  return s;
}

MatrixRBasis matrix_r_basis(float lambda_nm) {
  constexpr float last = matrix_r_bands - 1;
  const float x = (lambda_nm - static_cast<float>(lambda_min_nm)) / step;
  const float at = x > 0 ? (x < last ? x : last) : 0;
  const std::size_t band = at < last ? static_cast<std::size_t>(at) : matrix_r_bands - 2;
  MatrixRBasis basis{.part_above = at - static_cast<float>(band)};
  for (std::size_t c = 0; c < 3; ++c) {
    basis.below[c] = static_cast<float>(matrix_a()[band][c]);
    basis.above[c] = static_cast<float>(matrix_a()[band + 1][c]);
  }
  return basis;
}

RGB reflected_rgb(const BandReflectance& reflectance) {
  Column3 xyz{};
  for (std::size_t i = 0; i < reflectance.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) xyz[c] += matrix_a()[i][c] * reflectance[i];
  return rgb_of(xyz);
}

RGB reflected_rgb(const Spectrum& reflectance) {
  Column3 xyz{};
  for (std::size_t i = 0; i < table_size; ++i) {
    const double s = evaluate(reflectance, lambda_min_nm + static_cast<double>(i));
    for (std::size_t c = 0; c < 3; ++c) xyz[c] += weight_at_1nm(i)[c] * s;
  }
  return rgb_of(xyz);
}

TabulatedSpectrum tabulated(const BandReflectance& reflectance) {
  TabulatedSpectrum table;
  for (std::size_t i = 0; i < table_size; ++i) {
    const std::size_t band = i / step;
    const double part = static_cast<double>(i % step) / step;
    const double next = part > 0 ? reflectance[band + 1] : 0;
    table.values.push_back(static_cast<float>((1 - part) * reflectance[band] + part * next));
  }
  return table;
}

namespace {

bool is_grey(const std::array<float, 3>& c) { return c[0] == c[1] && c[1] == c[2]; }

// S of rgb/scale, times scale.
Spectrum colored(const std::array<float, 3>& rgb, double scale) {
  const auto part = [&](std::size_t i) { return static_cast<double>(rgb[i]) / scale; };
  return scaled(tabulated(matrix_r_reflectance({part(0), part(1), part(2)})), scale);
}

}  // namespace

Spectrum resolved(const Spectrum& spectrum, RgbMethod method) {
  if (method == RgbMethod::bands) return in_bands(spectrum);
  if (method == RgbMethod::matrix_r) {
    if (const auto* s = std::get_if<SigmoidSpectrum>(&spectrum); s && !is_grey(s->rgb))
      return colored(s->rgb, 1);
    if (const auto* s = std::get_if<RgbUnboundedSpectrum>(&spectrum); s && !is_grey(s->rgb))
      return colored(s->rgb, static_cast<double>(s->scale));
    if (const auto* s = std::get_if<RgbIlluminantSpectrum>(&spectrum); s && !is_grey(s->rgb))
      return product(resolved(emission_from_rgb({1, 1, 1})), colored(s->rgb, static_cast<double>(s->scale)));
  }
  return resolved(spectrum);
}

}  // namespace vitrail
