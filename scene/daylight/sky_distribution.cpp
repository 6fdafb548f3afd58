// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/sky_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/geometry/pi.h"
#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

// a, b, c, d, e of ISO 15469:2004, table 1.
constexpr double cie_types[15][5] = {
    {4, -0.7, 0, -1, 0},        {4, -0.7, 2, -1.5, 0.15},  {1.1, -0.8, 0, -1, 0},
    {1.1, -0.8, 2, -1.5, 0.15}, {0, -1, 0, -1, 0},         {0, -1, 2, -1.5, 0.15},
    {0, -1, 5, -2.5, 0.3},      {0, -1, 10, -3, 0.45},     {-1, -0.55, 2, -1.5, 0.15},
    {-1, -0.55, 5, -2.5, 0.3},  {-1, -0.55, 10, -3, 0.45}, {-1, -0.32, 10, -3, 0.45},
    {-1, -0.32, 16, -3, 0.3},   {-1, -0.15, 16, -3, 0.3},  {-1, -0.15, 24, -2.8, 0.15}};

// Perez et al. 1993, table 1: by clearness; of a … e the four numbers that go with the sun's zenith distance
// and the brightness.
constexpr std::size_t clearness_bins = 8;
constexpr double perez_shape[clearness_bins][5][4] = {{{1.3525, -0.2576, -0.2690, -1.4366},
                                                       {-0.7670, 0.0007, 1.2734, -0.1233},
                                                       {2.8000, 0.6004, 1.2375, 1.0000},
                                                       {1.8734, 0.6297, 0.9738, 0.2809},
                                                       {0.0356, -0.1246, -0.5718, 0.9938}},
                                                      {{-1.2219, -0.7730, 1.4148, 1.1016},
                                                       {-0.2054, 0.0367, -3.9128, 0.9156},
                                                       {6.9750, 0.1774, 6.4477, -0.1239},
                                                       {-1.5798, -0.5081, -1.7812, 0.1080},
                                                       {0.2624, 0.0672, -0.2190, -0.4285}},
                                                      {{-1.1000, -0.2515, 0.8952, 0.0156},
                                                       {0.2782, -0.1812, -4.5000, 1.1766},
                                                       {24.7219, -13.0812, -37.7000, 34.8438},
                                                       {-5.0000, 1.5218, 3.9229, -2.6204},
                                                       {-0.0156, 0.1597, 0.4199, -0.5562}},
                                                      {{-0.5484, -0.6654, -0.2672, 0.7117},
                                                       {0.7234, -0.6219, -5.6812, 2.6297},
                                                       {33.3389, -18.3000, -62.2500, 52.0781},
                                                       {-3.5000, 0.0016, 1.1477, 0.1062},
                                                       {0.4659, -0.3296, -0.0876, -0.0329}},
                                                      {{-0.6000, -0.3566, -2.5000, 2.3250},
                                                       {0.2937, 0.0496, -5.6812, 1.8415},
                                                       {21.0000, -4.7656, -21.5906, 7.2492},
                                                       {-3.5000, -0.1554, 1.4062, 0.3988},
                                                       {0.0032, 0.0766, -0.0656, -0.1294}},
                                                      {{-1.0156, -0.3670, 1.0078, 1.4051},
                                                       {0.2875, -0.5328, -3.8500, 3.3750},
                                                       {14.0000, -0.9999, -7.1406, 7.5469},
                                                       {-3.4000, -0.1078, -1.0750, 1.5702},
                                                       {-0.0672, 0.4016, 0.3017, -0.4844}},
                                                      {{-1.0000, 0.0211, 0.5025, -0.5119},
                                                       {-0.3000, 0.1922, 0.7023, -1.6317},
                                                       {19.0000, -5.0000, 1.2438, -1.9094},
                                                       {-4.0000, 0.0250, 0.3844, 0.2656},
                                                       {1.0468, -0.3788, -2.4517, 1.4656}},
                                                      {{-1.0500, 0.0289, 0.4260, 0.3590},
                                                       {-0.3250, 0.1156, 0.7781, 0.0025},
                                                       {31.0625, -14.5000, -46.1148, 55.3750},
                                                       {-7.2312, 0.4050, 13.3500, 0.6234},
                                                       {1.5000, -0.6426, 1.8564, 0.5636}}};

// Perez et al. 1990, table 4: lm/W of the sky, and of the sun.
constexpr double diffuse_efficacy[clearness_bins][4] = {
    {97.24, -0.46, 12.00, -8.91},   {107.22, 1.15, 0.59, -3.95},    {104.97, 2.96, -5.53, -8.77},
    {102.39, 5.59, -13.95, -13.90}, {100.71, 5.94, -22.75, -23.74}, {106.42, 3.83, -36.15, -28.83},
    {141.88, 1.90, -53.24, -14.03}, {152.23, 0.35, -45.27, -7.98}};
constexpr double direct_efficacy[clearness_bins][4] = {
    {57.20, -4.55, -2.98, 117.12}, {98.99, -3.46, -1.21, 12.38},  {109.83, -4.90, -1.71, -8.81},
    {110.34, -5.84, -1.99, -4.56}, {106.36, -3.97, -1.75, -6.16}, {107.19, -1.25, -1.51, -26.73},
    {105.75, 0.77, -1.26, -34.44}, {101.18, 1.58, -1.10, -8.29}};
constexpr double water_cm = 2;

double day_of_year(const LocalTime& time) {
  return days_from_2000(time) - days_from_2000({time.year, 1, 1, time.hour, time.timezone_h});  // from 0
}

// What the air and the distance of the sun make of two irradiances.
class PerezState {
 public:
  PerezState(double direct_w, double diffuse_w, const SunPosition& sun, const LocalTime& time)
      : direct_w_(direct_w), diffuse_w_(diffuse_w), zenith_(pi / 2 - sun.elevation_deg * radian) {
    const double z3 = 1.041 * zenith_ * zenith_ * zenith_;
    const double clearness = std::clamp(((diffuse_w + direct_w) / diffuse_w + z3) / (1 + z3), 1.0, 12.01);
    constexpr double bounds[] = {1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2};
    bin_ = static_cast<std::size_t>(std::ranges::upper_bound(bounds, clearness) - std::begin(bounds));
    // Spencer 1971; the relative air mass of Kasten 1966.
    const double angle = 2 * pi * day_of_year(time) / 365;
    const double nearness = 1.00011 + 0.034221 * portable_cos(angle) + 0.00128 * portable_sin(angle) +
                            0.000719 * portable_cos(2 * angle) + 0.000077 * portable_sin(2 * angle);
    const double air_mass =
        1 / (portable_cos(zenith_) + 0.15 * portable_pow(93.885 - zenith_ / radian, -1.253));
    constexpr double solar_constant_w = 1367;
    brightness_ = std::clamp(diffuse_w * air_mass / (solar_constant_w * nearness), 0.01, 0.6);
  }

  double diffuse_lx() const {
    const double* k = diffuse_efficacy[bin_];
    const double efficacy =
        k[0] + k[1] * water_cm + k[2] * portable_cos(zenith_) + k[3] * portable_log(brightness_);
    return diffuse_w_ * efficacy;
  }
  double direct_lx() const {
    const double* k = direct_efficacy[bin_];
    return direct_w_ * std::max(0.0, k[0] + k[1] * water_cm + k[2] * portable_exp(5.73 * zenith_ - 5) +
                                         k[3] * brightness_);
  }
  SkyDistribution distribution() const {
    // Between these clearnesses the darkest skies are not in the data.
    const double bright = bin_ > 0 && bin_ < 5 ? std::max(0.2, brightness_) : brightness_;
    const auto of = [&](std::size_t row) {
      const auto& k = perez_shape[bin_][row];
      return k[0] + k[1] * zenith_ + bright * (k[2] + k[3] * zenith_);
    };
    SkyDistribution sky{.a = of(0), .b = of(1), .base = 1, .c = of(2), .d = of(3), .e = of(4)};
    if (bin_ == 0) {
      const auto &c = perez_shape[0][2], &d = perez_shape[0][3];
      sky.c = portable_exp(portable_pow(bright * (c[0] + c[1] * zenith_), c[2])) - c[3];
      sky.d = -portable_exp(bright * (d[0] + d[1] * zenith_)) + d[2] + bright * d[3];
    }
    sky.diffuse_lx = diffuse_lx();
    return sky;
  }

 private:
  double direct_w_, diffuse_w_, zenith_, brightness_ = 0;
  std::size_t bin_ = 0;
};

}  // namespace

double gradient_of(const SkyDistribution& sky, double cosine) {
  return 1 + sky.a * portable_exp(sky.b / std::max(cosine, 0.01));
}

double scattering_of(const SkyDistribution& sky, double sun_cosine) {
  return sky.base + sky.c * portable_exp(sky.d * portable_acos(sun_cosine)) + sky.e * sun_cosine * sun_cosine;
}

MeasuredSky cie_sky(int type, const SunPosition& sun, const LocalTime& time) {
  const double* k = cie_types[type - 1];
  MeasuredSky sky{.distribution = {.a = k[0],
                                   .b = k[1],
                                   .base = 1 - k[2] * portable_exp(k[3] * pi / 2),
                                   .c = k[2],
                                   .d = k[3],
                                   .e = k[4]}};
  const double height = portable_sin(sun.elevation_deg * radian);
  if (!(height > 0)) return sky;
  const double solar_lx = 127500 * (1 + 0.034 * portable_cos(2 * pi * (day_of_year(time) - 1) / 365));
  if (type <= 5) {
    sky.distribution.diffuse_lx = 300 + 21000 * height;
  } else if (type <= 10) {
    sky.distribution.diffuse_lx = 300 + 45000 * height;
    sky.direct_normal_lx = solar_lx * portable_exp(-0.8 / height);
  } else {
    sky.distribution.diffuse_lx = 800 + 15500 * std::sqrt(height);
    sky.direct_normal_lx = solar_lx * portable_exp(-0.21 / height);
  }
  return sky;
}

MeasuredSky perez_sky(double direct_normal_w, double diffuse_horizontal_w, const SunPosition& sun,
                      const LocalTime& time) {
  // Of a sun without any sky the clearness would have no bound.
  const double diffuse_w = std::max(diffuse_horizontal_w, 1e-6 * direct_normal_w);
  if (!(diffuse_w > 0) || !(sun.elevation_deg > 0)) return {};
  const PerezState state(direct_normal_w, diffuse_w, sun, time);
  return {state.distribution(), state.direct_lx()};
}

MeasuredSky perez_sky_of_lux(double direct_normal_lx, double diffuse_horizontal_lx, const SunPosition& sun,
                             const LocalTime& time) {
  const double diffuse_lx = std::max(diffuse_horizontal_lx, 1e-6 * direct_normal_lx);
  if (!(diffuse_lx > 0) || !(sun.elevation_deg > 0)) return {};
  constexpr double usual_efficacy = 110;
  double direct_w = direct_normal_lx / usual_efficacy, diffuse_w = diffuse_lx / usual_efficacy;
  // Efficacies change slowly, but they jump from one clearness to the next: there it may go to and fro.
  for (int i = 0; i < 50; ++i) {
    const PerezState state(direct_w, diffuse_w, sun, time);
    diffuse_w *= diffuse_lx / state.diffuse_lx();
    if (direct_w > 0 && state.direct_lx() > 0) direct_w *= direct_normal_lx / state.direct_lx();
  }
  MeasuredSky sky{PerezState(direct_w, diffuse_w, sun, time).distribution(), direct_normal_lx};
  sky.distribution.diffuse_lx = diffuse_horizontal_lx;
  return sky;
}

}  // namespace vitrail
