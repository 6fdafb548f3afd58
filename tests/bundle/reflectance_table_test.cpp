// SPDX-License-Identifier: Apache-2.0
#include "bundle/reflectances/reflectance_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::reflectance_table_test {

namespace {

using Color = std::array<float, 3>;

double reflectance(const SigmoidNodes& x, double lambda) {
  const double t = (lambda - 595) / 235;
  const double v = t * (t - 1) / 2 * static_cast<double>(x[0]) + (1 - t * t) * static_cast<double>(x[1]) +
                   t * (t + 1) / 2 * static_cast<double>(x[2]);
  return 0.5 + v / (2 * std::sqrt(1 + v * v));
}

double difference(const SigmoidNodes& a, const SigmoidNodes& b) {
  double greatest = 0;
  for (double lambda = lambda_min_nm; lambda <= lambda_max_nm; lambda += 10)
    greatest = std::max(greatest, std::abs(reflectance(a, lambda) - reflectance(b, lambda)));
  return greatest;
}

SigmoidNodes fitted(const Color& c) {
  return nodes_of(reflectance_from_rgb(
      {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])}));
}

struct Agreement {
  double found = 0, greatest = 0, mean = 0;
  Color where{};
};

Agreement agreement(int colors, const std::function<double(double, int)>& component) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0, 1);
  Agreement a;
  for (int i = 0; i < colors; ++i) {
    const double common = u(random);  // all components may know it
    Color c;
    for (float& v : c)
      v = static_cast<float>(std::clamp(component(u(random), static_cast<int>(common * 1e6)), 0.0, 1.0));
    const auto nodes = tabulated_reflectance(c);
    if (!nodes) continue;
    const double d = difference(*nodes, fitted(c));
    if (!(d <= a.greatest)) a.greatest = d, a.where = c;
    a.found += 1, a.mean += d;
  }
  a.mean /= a.found, a.found /= colors;
  return a;
}

void expect_close(const Agreement& a, double found) {
  EXPECT_GT(a.found, found);
  EXPECT_LT(a.greatest, 5e-4) << a.where[0] << ' ' << a.where[1] << ' ' << a.where[2];
  EXPECT_LT(a.mean, 7e-6);
}

TEST(ReflectanceTable, AgreesWithFitsAllOverTheCube) {
  expect_close(agreement(20000, [](double v, int) { return v; }), 0.97);
}

TEST(ReflectanceTable, AgreesWithFitsOfPixels) {
  expect_close(agreement(20000, [](double v, int) { return srgb_decode(std::floor(256 * v) / 255); }), 0.92);
}

TEST(ReflectanceTable, AgreesWithFitsOfDarkSaturatedColors) {
  expect_close(agreement(20000, [](double v, int) { return std::pow(v, 4); }), 0.88);
}

TEST(ReflectanceTable, AgreesWithFitsNearTheGreys) {
  expect_close(
      agreement(20000, [](double v, int common) { return srgb_decode(common * 1e-6 + 0.1 * (v - 0.5)); }),
      0.92);
}

TEST(ReflectanceTable, AgreesWithFitsOfBrightColors) {
  expect_close(agreement(20000, [](double v, int) { return 1 - std::pow(v, 4); }), 0.88);
}

TEST(ReflectanceTable, AgreesWithFitsAtTheEdgesOfTheGamut) {
  constexpr std::array edges{0.0f, 1e-30f, 1e-6f, 1e-4f, 3e-4f,     0.01f,
                             0.2f, 0.5f,   0.8f,  0.99f, 1 - 1e-6f, 1.0f};
  int found = 0;
  for (const float r : edges)
    for (const float g : edges)
      for (const float b : edges)
        if (const auto nodes = tabulated_reflectance({r, g, b})) {
          ++found;
          EXPECT_LT(difference(*nodes, fitted({r, g, b})), 5e-4) << r << ' ' << g << ' ' << b;
        }
  EXPECT_GT(found, 300);
}

TEST(ReflectanceTable, LeavesGreysAndWhatIsOutsideToTheFit) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Color c : {Color{0, 0, 0}, Color{1, 1, 1}, Color{0.3f, 0.3f, 0.3f}, Color{-0.1f, 0.5f, 0.5f},
                        Color{0.5f, 1.1f, 0.5f}, Color{nan, 0.5f, 0.5f}, Color{0.5f, 0.4f, nan}})
    EXPECT_FALSE(tabulated_reflectance(c)) << c[0] << ' ' << c[1] << ' ' << c[2];
  EXPECT_TRUE(tabulated_reflectance({0.5f, 0.4f, 0.3f}));
}

}  // namespace

}  // namespace vitrail::reflectance_table_test
