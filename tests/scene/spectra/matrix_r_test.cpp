// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/matrix_r.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

namespace vitrail::matrix_r_test {
namespace {

double error(RGB a, RGB b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

// VITRAIL_LONG_TESTS: a million colours, as docs/why/color-and-film.md has them.
TEST(MatrixR, EveryColorComesBackFromAReflectance) {
  const int n = std::getenv("VITRAIL_LONG_TESTS") ? 100 : 25;
  double worst = 0, least = 0, greatest = 0;
  const auto part = [&](int i) { return static_cast<double>(i) / (n - 1); };
  for (int i = 0; i < n * n * n; ++i) {
    const RGB c{part(i / n / n), part(i / n % n), part(i % n)};
    const BandReflectance s = matrix_r_reflectance(c);
    worst = std::max(worst, error(reflected_rgb(s), c));
    least = std::min(least, *std::ranges::min_element(s));
    greatest = std::max(greatest, *std::ranges::max_element(s));
  }
  EXPECT_LE(worst, 1e-9);
  EXPECT_GE(least, 0);
  EXPECT_LE(greatest, 1);
}

// Nearly white, nearly black, nearly on an edge: where least is free.
TEST(MatrixR, ColorsNearTheSurfaceComeBack) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-9, 0);
  for (int i = 0; i < 20000; ++i) {
    const auto component = [&] {
      const double x = std::pow(10, exponent(random));
      return random() % 2 ? x : 1 - x;
    };
    const RGB c{component(), component(), component()};
    EXPECT_LE(error(reflected_rgb(matrix_r_reflectance(c)), c), 1e-7) << c.r << ' ' << c.g << ' ' << c.b;
  }
}

// Cohen & Kappauf: the fundamental of any reflectance of a colour is one and the same, and colours add.
TEST(MatrixR, FundamentalsAreLinearAndExact) {
  const RGB a{0.3, 0.5, 0.1}, b{0.2, 0.1, 0.4};
  const BandReflectance na = fundamental_metamer(a), nb = fundamental_metamer(b),
                        sum = fundamental_metamer({a.r + b.r, a.g + b.g, a.b + b.b});
  for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_NEAR(na[i] + nb[i], sum[i], 1e-12);
  EXPECT_LE(error(reflected_rgb(na), a), 1e-12);
  const BandReflectance white = fundamental_metamer({1, 1, 1});
  EXPECT_GT(*std::ranges::max_element(white), 1.2);  // why it has to be bounded
}

// Where the fundamental is a reflectance already, nothing is added to it.
TEST(MatrixR, AddsNoBlackWhereNoneIsNeeded) {
  const RGB c{0.35, 0.35, 0.36};
  const BandReflectance n = fundamental_metamer(c), s = matrix_r_reflectance(c);
  ASSERT_GE(*std::ranges::min_element(n), 0);
  for (std::size_t i = 0; i < n.size(); ++i) EXPECT_NEAR(n[i], s[i], 1e-9);
}

TEST(MatrixR, GreysAreConstantAndTablesAgree) {
  for (const double v : matrix_r_reflectance({0.4, 0.4, 0.4})) EXPECT_EQ(v, 0.4);
  const RGB c{0.8, 0.1, 0.3};
  EXPECT_LE(error(reflected_rgb(Spectrum{tabulated(matrix_r_reflectance(c))}), c), 1e-6);
}

}  // namespace
}  // namespace vitrail::matrix_r_test
