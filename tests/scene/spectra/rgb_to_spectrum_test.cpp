// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/rgb_to_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vitrail::rgb_to_spectrum_test {
namespace {

// The colour of a reflectance under D65.
RGB color_of(const SigmoidSpectrum& reflectance) {
  return xyz_to_srgb(to_xyz(RgbIlluminantSpectrum{reflectance, 1}));
}

std::array<double, 3> lab(RGB c) {
  const XYZ v = srgb_to_xyz(c), white = srgb_to_xyz({1, 1, 1});
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f(v.x / white.x), y = f(v.y / white.y), z = f(v.z / white.z);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double delta_e(RGB a, RGB b) {
  const auto p = lab(a), q = lab(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

TEST(RgbToReflectance, GridRoundTrips) {
  double worst = 0;
  for (int r = 0; r <= 16; ++r)
    for (int g = 0; g <= 16; ++g)
      for (int b = 0; b <= 16; ++b) {
        const RGB c{r / 16.0, g / 16.0, b / 16.0};
        worst = std::fmax(worst, delta_e(color_of(reflectance_from_rgb(c)), c));
      }
  EXPECT_LT(worst, 0.005);
  RecordProperty("worst_delta_e", std::to_string(worst));
}

TEST(RgbToReflectance, ExtremesConvergeAndAreFinite) {
  for (const RGB c : {RGB{1e-9, 0, 0}, RGB{0, 1e-5, 0}, RGB{1, 1, 0.9999}, RGB{0.9999, 1, 1}, RGB{1, 1e-7, 0},
                      RGB{0.5, 0.5, 0.5000001}, RGB{0, 0, 0.00045422383}}) {
    const SigmoidSpectrum s = reflectance_from_rgb(c);
    EXPECT_TRUE(std::isfinite(s.c0) && std::isfinite(s.c1) && std::isfinite(s.c2))
        << c.r << ' ' << c.g << ' ' << c.b;
    EXPECT_LT(delta_e(color_of(s), c), 0.005) << c.r << ' ' << c.g << ' ' << c.b;
  }
}

TEST(RgbToReflectance, GreysAreExactConstants) {
  for (const double v : {0.0, 1e-6, 0.18, 0.5, 0.999, 1.0}) {
    const SigmoidSpectrum s = reflectance_from_rgb({v, v, v});
    EXPECT_EQ(s.c0, 0);
    EXPECT_EQ(s.c1, 0);
    EXPECT_NEAR(evaluate(s, 450), v, 1e-7);
  }
  EXPECT_EQ(evaluate(reflectance_from_rgb({0, 0, 0}), 500), 0);
  EXPECT_EQ(evaluate(reflectance_from_rgb({1, 1, 1}), 500), 1);
}

TEST(RgbToReflectance, ClampsToTheUnitCube) {
  EXPECT_EQ(reflectance_from_rgb({2, -1, 0.5}), reflectance_from_rgb({1, 0, 0.5}));
}

TEST(RgbToReflectance, StaysWithinZeroAndOne) {
  const SigmoidSpectrum s = reflectance_from_rgb({0, 0, 1});
  for (double lambda = lambda_min_nm; lambda <= lambda_max_nm; ++lambda) {
    EXPECT_GE(evaluate(s, lambda), 0);
    EXPECT_LE(evaluate(s, lambda), 1);
  }
}

TEST(RgbToEmission, HasItsColour) {
  for (const RGB c : {RGB{1, 1, 1}, RGB{17, 12, 4}, RGB{0, 0, 0.01}, RGB{1e6, 0, 1e6}}) {
    const RGB back = xyz_to_srgb(to_xyz(emission_from_rgb(c)));
    const double tolerance = 2e-5 * std::fmax(c.r, std::fmax(c.g, c.b));
    EXPECT_NEAR(back.r, c.r, tolerance);
    EXPECT_NEAR(back.g, c.g, tolerance);
    EXPECT_NEAR(back.b, c.b, tolerance);
  }
}

TEST(RgbToEmission, NothingBelowZero) {
  EXPECT_EQ(emission_from_rgb({0, 0, 0}), RgbIlluminantSpectrum{});
  EXPECT_EQ(emission_from_rgb({-1, 3, -1}), emission_from_rgb({0, 3, 0}));
}

}  // namespace
}  // namespace vitrail::rgb_to_spectrum_test
