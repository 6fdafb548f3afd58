// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;
using Column3 = std::array<double, 3>;

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

Column3 operator*(const Matrix3& a, const Column3& v) {
  Column3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) c[i] += a[i][k] * v[k];
  return c;
}

Matrix3 inverse(const Matrix3& m) {
  const auto minor = [&m](std::size_t r, std::size_t c) {
    const std::size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix3 result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = minor(j, i) / det;
  return result;
}

Column3 xyz_of_unit_luminance(Chromaticity c) { return {c.x / c.y, 1, (1 - c.x - c.y) / c.y}; }

// Columns are the XYZ of the primaries, scaled so that (1,1,1) is the white (SMPTE RP 177-1993).
Matrix3 rgb_to_xyz(const std::array<Chromaticity, 3>& primaries, const Column3& white) {
  Matrix3 m{};
  for (std::size_t j = 0; j < 3; ++j) {
    const Column3 p = xyz_of_unit_luminance(primaries[j]);
    for (std::size_t i = 0; i < 3; ++i) m[i][j] = p[i];
  }
  const Column3 weight = inverse(m) * white;
  for (auto& row : m)
    for (std::size_t j = 0; j < 3; ++j) row[j] *= weight[j];
  return m;
}

// The white of the tabulated D65 rather than the rounded x = 0.3127, y = 0.3290 of the standards (4·10⁻⁵
// away), so that the spectrum of the colour (1,1,1) comes back as (1,1,1).
const Column3& d65_white() {
  static const Column3 white = [] {
    const auto& d65 = cie_d65();
    const XYZ w = to_xyz(TabulatedSpectrum{{d65.begin(), d65.end()}});
    return Column3{w.x, w.y, w.z};
  }();
  return white;
}

const Matrix3& srgb_matrix() {
  static const Matrix3 m = rgb_to_xyz({{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}}, d65_white());
  return m;
}

const Matrix3& inverse_srgb_matrix() {
  static const Matrix3 m = inverse(srgb_matrix());
  return m;
}

// Bradford's linear chromatic adaptation (Lam 1985; ICC.1:2022, annex E) to D65.
Matrix3 adapt_to_d65(const Column3& white) {
  const Matrix3 bradford{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Column3 from = bradford * white, to = bradford * d65_white();
  const Matrix3 gain{{{to[0] / from[0], 0, 0}, {0, to[1] / from[1], 0}, {0, 0, to[2] / from[2]}}};
  return inverse(bradford) * gain * bradford;
}

struct Space {
  const char* name;
  Chromaticities c;
};
constexpr Chromaticity d65{0.3127, 0.3290};
// IEC 61966-2-1; ITU-R BT.2020; SMPTE RP 431-2 primaries with D65; SMPTE ST 2065-1.
constexpr std::array<Space, 4> spaces{
    {{"srgb", {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, d65}},
     {"rec2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, d65}},
     {"dci-p3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, d65}},
     {"aces2065-1", {{0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}, {0.32168, 0.33767}}}}};

// From linear RGB of a space to XYZ under D65.
Matrix3 space_to_xyz(const std::string& space) {
  const auto known =
      std::find_if(spaces.begin(), spaces.end(), [&](const Space& s) { return s.name == space; });
  if (known == spaces.end())
    throw Error(
        fmt::format("unknown colour space \"{}\": known are srgb, rec2020, dci-p3 and aces2065-1", space));
  const Chromaticities& c = known->c;
  if (c.white == d65) return rgb_to_xyz({c.red, c.green, c.blue}, d65_white());
  const Column3 white = xyz_of_unit_luminance(c.white);
  return adapt_to_d65(white) * rgb_to_xyz({c.red, c.green, c.blue}, white);
}

bool is_near(Chromaticity a, Chromaticity b) {
  const auto close = [](double value, double to) { return std::abs(value - to) <= 1e-3 * std::abs(to); };
  return close(a.x, b.x) && close(a.y, b.y);
}

// Proportional to XYZ, also of a colour without luminance.
Column3 along(Chromaticity c) { return {c.x, c.y, 1 - c.x - c.y}; }

}  // namespace

XYZ srgb_to_xyz(RGB c) {
  const Column3 v = srgb_matrix() * Column3{c.r, c.g, c.b};
  return {v[0], v[1], v[2]};
}

RGB xyz_to_srgb(XYZ c) {
  const Column3 v = inverse_srgb_matrix() * Column3{c.x, c.y, c.z};
  return {v[0], v[1], v[2]};
}

RGB to_srgb(RGB c, const char* color_space) {
  const std::string space = color_space;
  if (space == "srgb") return c;
  const Column3 v = inverse_srgb_matrix() * (space_to_xyz(space) * Column3{c.r, c.g, c.b});
  return {v[0], v[1], v[2]};
}

const char* color_space_of(const Chromaticities& c) {
  for (const Space& s : spaces)
    if (is_near(c.red, s.c.red) && is_near(c.green, s.c.green) && is_near(c.blue, s.c.blue) &&
        is_near(c.white, s.c.white))
      return s.name;
  return nullptr;
}

std::array<RGB, 3> primaries_in_srgb(const Chromaticities& c) {
  const std::array directions{along(c.red), along(c.green), along(c.blue)};
  Matrix3 m{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = directions[j][i];
  const Column3 weight = inverse(m) * xyz_of_unit_luminance(c.white);
  std::array<RGB, 3> result;
  for (std::size_t j = 0; j < 3; ++j)
    result[j] = xyz_to_srgb(
        {directions[j][0] * weight[j], directions[j][1] * weight[j], directions[j][2] * weight[j]});
  return result;
}

// IEC 61966-2-1:1999, 5.2 and 5.3.
double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

XYZ to_xyz(const Spectrum& emission) {
  const Spectrum known = resolved(emission);
  XYZ sum;
  for (std::size_t i = 0; i < table_size; ++i) {
    const double value = evaluate(known, lambda_min_nm + static_cast<double>(i));
    const auto& cmf = cie_1931()[i];
    sum.x += value * static_cast<double>(cmf[0]);
    sum.y += value * static_cast<double>(cmf[1]);
    sum.z += value * static_cast<double>(cmf[2]);
  }
  return {sum.x / cie_y_integral_nm, sum.y / cie_y_integral_nm, sum.z / cie_y_integral_nm};
}

}  // namespace vitrail
