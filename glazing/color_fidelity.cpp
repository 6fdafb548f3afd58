// SPDX-License-Identifier: Apache-2.0
#include "glazing/color_fidelity.h"

#include <array>
#include <cmath>
#include <numbers>

#include "glazing/color_fidelity_tables.h"
#include "glazing/evaluation.h"
#include "glazing/standard_tables.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

constexpr std::size_t wavelength_count = 81;
using Power = std::array<double, wavelength_count>;  // each 5 nm from 380 nm
using Tristimulus = std::array<double, 3>;
using Matrix = std::array<std::array<double, 3>, 3>;

double wavelength(std::size_t i) { return 380 + 5 * static_cast<double>(i); }

Tristimulus times(const Matrix& m, const Tristimulus& v) {
  Tristimulus result{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) result[row] += m[row][column] * v[column];
  return result;
}

Power planck(double kelvin) {
  constexpr double second_constant_nm_k = 1.438776877e7;
  Power power{};
  for (std::size_t i = 0; i < power.size(); ++i)
    power[i] =
        1 / (std::pow(wavelength(i) / 560, 5) * std::expm1(second_constant_nm_k / (wavelength(i) * kelvin)));
  return power;
}

// CIE 15, equations (3.2) to (3.5).
Power daylight(double kelvin) {
  const double t = 1000 / kelvin;
  const double x = kelvin <= 7000 ? 0.244063 + t * (0.09911 + t * (2.9678 - 4.6070 * t))
                                  : 0.237040 + t * (0.24748 + t * (1.9018 - 2.0064 * t));
  const double y = -3 * x * x + 2.870 * x - 0.275, m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m, m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
  Power power{};
  for (std::size_t i = 0; i < power.size(); ++i) {
    const auto& s = cie_daylight_5nm()[i];
    power[i] = s[0] + m1 * s[1] + m2 * s[2];
  }
  return power;
}

double luminance(const Power& power) {
  double y = 0;
  for (std::size_t i = 0; i < power.size(); ++i) y += power[i] * cie_1964_5nm()[i + 4][1];
  return y;
}

// Planck's to 4000 K, daylight from 5000 K, both in between, each by its luminance.
Power reference_light(double kelvin) {
  if (kelvin <= 4000) return planck(kelvin);
  if (kelvin >= 5000) return daylight(kelvin);
  const Power warm = planck(kelvin), cool = daylight(kelvin);
  const double part = (kelvin - 4000) / 1000;
  Power mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i)
    mixed[i] = (1 - part) * warm[i] / luminance(warm) + part * cool[i] / luminance(cool);
  return mixed;
}

// CIE 1960 u, v for the 2° observer.
std::array<double, 2> chromaticity(const Power& power) {
  Tristimulus xyz{};
  for (std::size_t i = 0; i < power.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      xyz[c] += power[i] * static_cast<double>(cie_1931()[20 + 5 * i][c]);  // each 1 nm from 360
  const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
  return {4 * xyz[0] / sum, 6 * xyz[1] / sum};
}

// Nearest on Planck's locus from 1000 to 25 000 K: a scan in reciprocal temperature, then golden sections.
double color_temperature(const Power& power) {
  const auto at = chromaticity(power);
  const auto distance = [&](double mired) {
    const auto on = chromaticity(planck(1e6 / mired));
    return std::hypot(on[0] - at[0], on[1] - at[1]);
  };
  constexpr double coolest = 40, warmest = 1000, step = 10;
  double best = coolest;
  for (double mired = coolest; mired <= warmest; mired += step)
    if (distance(mired) < distance(best)) best = mired;
  double low = std::max(coolest, best - step), high = std::min(warmest, best + step);
  while (high - low > 1e-4) {
    const double golden = (std::numbers::phi - 1) * (high - low);
    if (distance(high - golden) < distance(low + golden))
      high = low + golden;
    else
      low = high - golden;
  }
  return 2e6 / (low + high);
}

// J′, a′, b′ and the hue in turns.
struct Appearance {
  double j = 0, a = 0, b = 0, hue = 0;
};

// CIECAM02 (CIE 159:2004) with L_A 100 cd/m², Y_b 20, an average surround and full adaptation; CAM02-UCS of
// Luo, Cui and Li (2006). White and colours have the white's Y at 100.
class Observer02 {
 public:
  explicit Observer02(const Tristimulus& white)
      : sharp_white_(times(cat02, white)), white_(response(white)) {}

  Appearance operator()(const Tristimulus& xyz) const {
    const auto [r, g, b] = response(xyz);
    const double red_green = r - 12 * g / 11 + b / 11, yellow_blue = (r + g - 2 * b) / 9;
    const double hue = std::atan2(yellow_blue, red_green), eccentricity = (std::cos(hue + 2) + 3.8) / 4;
    const double t =
        50000.0 / 13 * background * eccentricity * std::hypot(red_green, yellow_blue) / (r + g + 21 * b / 20);
    const double j =
        100 * std::pow(achromatic({r, g, b}) / achromatic(white_), 0.69 * (1.48 + std::sqrt(0.2)));
    const double chroma = std::pow(t, 0.9) * std::sqrt(j / 100) * std::pow(1.64 - std::pow(0.29, 0.2), 0.73);
    const double colorful = std::log1p(0.0228 * chroma * std::pow(luminance_factor, 0.25)) / 0.0228;
    return {1.7 * j / (1 + 0.007 * j), colorful * std::cos(hue), colorful * std::sin(hue),
            hue / (2 * std::numbers::pi) + (hue < 0 ? 1 : 0)};
  }

 private:
  static constexpr Matrix cat02{
      {{0.7328, 0.4296, -0.1624}, {-0.7036, 1.6975, 0.0061}, {0.0030, 0.0136, 0.9834}}};
  static constexpr Matrix cat02_inverse{
      {{1.096124, -0.278869, 0.182745}, {0.454369, 0.473533, 0.072098}, {-0.009628, -0.005698, 1.015326}}};
  static constexpr Matrix hunt{{{0.38971, 0.68898, -0.07868}, {-0.22981, 1.18340, 0.04641}, {0, 0, 1}}};
  static constexpr double luminance_factor = 0.7937005259841;  // F_L: 0.1 (5 L_A)^⅓; k⁴ is below 1e-10
  static constexpr double background = 1.0003040045593807;     // N_bb: 0.725 (Y_b/100)^−0.2

  static double achromatic(const Tristimulus& v) { return 2 * v[0] + v[1] + v[2] / 20 - 0.305; }

  Tristimulus response(const Tristimulus& xyz) const {
    Tristimulus sharp = times(cat02, xyz);
    for (std::size_t c = 0; c < 3; ++c) sharp[c] *= 100 / sharp_white_[c];
    Tristimulus v = times(hunt, times(cat02_inverse, sharp));
    for (double& value : v) {
      const double power = std::pow(luminance_factor * std::abs(value) / 100, 0.42);
      value = std::copysign(400 * power / (power + 27.13), value) + 0.1;
    }
    return v;
  }

  Tristimulus sharp_white_, white_;
};

std::array<Appearance, 99> seen_in(const Power& power) {
  const double scale = 100 / luminance(power);
  const auto observer_rows = cie_1964_5nm().subspan(4);  // from 380 nm
  const auto color_of = [&](auto reflectance) {
    Tristimulus xyz{};
    for (std::size_t i = 0; i < power.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) xyz[c] += scale * power[i] * reflectance(i) * observer_rows[i][c];
    return xyz;
  };
  const Observer02 observer(color_of([](std::size_t) { return 1.0; }));
  std::array<Appearance, 99> seen;
  for (std::size_t sample = 0; sample < seen.size(); ++sample)
    seen[sample] = observer(
        color_of([&](std::size_t i) { return static_cast<double>(cie_224_samples_5nm()[i][sample]); }));
  return seen;
}

// Area of the polygon of mean a′, b′ in each of 16 hues of the reference.
double gamut_area(const std::array<Appearance, 99>& seen, const std::array<Appearance, 99>& reference) {
  std::array<std::array<double, 3>, 16> sums{};
  for (std::size_t i = 0; i < seen.size(); ++i) {
    auto& sum = sums[std::min<std::size_t>(15, static_cast<std::size_t>(16 * reference[i].hue))];
    sum = {sum[0] + seen[i].a, sum[1] + seen[i].b, sum[2] + 1};
  }
  std::vector<std::array<double, 2>> corners;
  for (const auto& [a, b, count] : sums)
    if (count > 0) corners.push_back({a / count, b / count});
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &here = corners[i], &next = corners[(i + 1) % corners.size()];
    area += (here[0] * next[1] - here[1] * next[0]) / 2;
  }
  return area;
}

}  // namespace

std::optional<ColorFidelity> color_fidelity(const SystemSpectrum& spectrum) {
  Power light{};
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = cie_d65_5nm()[16 + i] * value_at(spectrum, wavelength(i)).t;  // from 300 nm
  if (!(luminance(light) > 0)) return {};
  const double kelvin = color_temperature(light);
  const auto seen = seen_in(light), reference = seen_in(reference_light(kelvin));
  double difference = 0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    difference +=
        std::hypot(seen[i].j - reference[i].j, seen[i].a - reference[i].a, seen[i].b - reference[i].b) /
        static_cast<double>(seen.size());
  return ColorFidelity{.fidelity = 10 * std::log1p(std::exp((100 - 6.73 * difference) / 10)),
                       .gamut = 100 * gamut_area(seen, reference) / gamut_area(reference, reference),
                       .kelvin = kelvin};
}

}  // namespace vitrail
