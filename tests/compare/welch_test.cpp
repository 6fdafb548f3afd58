// SPDX-License-Identifier: Apache-2.0
#include "compare/welch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/comparison.h"
#include "compare/ztest.h"
#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"

namespace vitrail::welch_tests {
namespace {

constexpr int side = 256;  // 1024 tiles

struct Render {
  Image image, variance;
  WelchPicture tested() const { return {&image, &variance}; }
};

// A ramp with noise that grows from left to right, as a film has it: the mean of two groups, and the variance
// that these two tell. `bias`(x, y) times the light.
template <class Bias>
Render render(std::uint64_t seed, double noise, const Bias& bias) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Render r{black_image(side, side, 3), black_image(side, side, 1)};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double light = (1 + 0.01 * y) * bias(x, y), sigma = noise * (0.1 + 0.01 * x);
      const double a = light + sigma * normal(random), b = light + sigma * normal(random);
      const auto p = static_cast<std::size_t>(y * side + x);
      for (std::size_t c = 0; c < 3; ++c) r.image.values[3 * p + c] = static_cast<float>((a + b) / 2);
      r.variance.values[p] = static_cast<float>((a - b) * (a - b) / 4);
    }
  return r;
}

double none(int, int) { return 1; }

TEST(Welch, IsEvenlySpreadWhereNothingDiffers) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Render a = render(2 * seed, 1, none), b = render(2 * seed + 1, 0.3, none);  // of unequal samples
    const WelchTest test = welch_test(a.tested(), b.tested());
    EXPECT_EQ(test.tested, 1024u);
    EXPECT_LT(test.distance, test.allowed_distance);
    for (const std::size_t count : test.histogram)
      EXPECT_NEAR(static_cast<double>(count), 102.4, 45);  // 4.7 σ
  }
}

TEST(Welch, FindsABiasBelowTheNoiseOfAPixel) {
  const Render a = render(1, 1, none), b = render(2, 1, [](int, int) { return 1.05; });
  const WelchTest test = welch_test(a.tested(), b.tested());
  EXPECT_GT(test.distance, test.allowed_distance);
  EXPECT_GT(test.histogram[0], 150u);
}

// By hand: σ² of the sums is 64·Σσ²; equal estimates of one degree each count 3·64 − 2 together.
TEST(Welch, IsStudentsTestOfATile) {
  Render a{black_image(8, 8, 3), {8, 8, 1, std::vector<float>(64, 0.01f)}}, b = a;
  double difference = 0;
  for (std::size_t p = 0; p < 64; ++p) {
    const float blue = 0.01f * static_cast<float>(p);
    a.image.values[3 * p + 2] = blue;
    difference += srgb_to_xyz({0, 0, static_cast<double>(blue)}).y;
  }
  for (const float of_b : {0.01f, 0.04f}) {
    b.variance.values.assign(64, of_b);
    const double va = 64 * 0.01, vb = 64 * static_cast<double>(of_b);
    const double freedom = (va + vb) * (va + vb) / (va * va / 190 + vb * vb / 190);
    EXPECT_NEAR(welch_test(a.tested(), b.tested()).p_values.at(0),
                two_sided_p(difference / std::sqrt(va + vb), static_cast<int>(freedom)), 1e-6);
  }
  EXPECT_THROW(welch_test(a.tested(), render(1, 1, none).tested()), Error);
}

TEST(Welch, IsAMetricWhoseValueIsTheDistance) {
  const Render a = render(1, 1, none), b = render(2, 1, [](int, int) { return 1.05; });
  const WelchTest test = welch_test(a.tested(), b.tested());
  const Comparison c =
      compare({&a.image, &b.image, {}, {}}, Metric::welch, std::nullopt, std::nullopt, {}, test);
  EXPECT_EQ(c.value, test.distance);
  EXPECT_EQ(c.threshold, test.allowed_distance);
  EXPECT_FALSE(c.passed);
}

TEST(Welch, ShowsWhere) {
  const Render a = render(1, 0.3, none),
               b = render(2, 0.3, [](int x, int y) { return x / 8 == 3 && y / 8 == 5 ? 2 : 1; });
  const WelchTest test = welch_test(a.tested(), b.tested());
  EXPECT_LT(test.p_values[5 * 32 + 3], 1e-6);
  const std::vector<double> map = welch_map(test, side, side);
  EXPECT_GT(map[47 * side + 31], 1 - 1e-6);
  EXPECT_EQ(map[48 * side + 31], 1 - test.p_values[6 * 32 + 3]);
}

// Noise that neighbours share makes a tile's mean scatter more.
TEST(Welch, KnowsOfNeighboursThatAreAlike) {
  const Render a = render(1, 1, none), b = render(2, 1, none);
  WelchPicture alike_a = a.tested(), alike_b = b.tested();
  alike_a.neighbours_of_mean = alike_b.neighbours_of_mean = 4;
  const WelchTest test = welch_test(alike_a, alike_b);
  EXPECT_GT(test.distance, test.allowed_distance) << "the noise is not that of neighbours alike";
  EXPECT_LT(test.histogram[0], 20u);
}

TEST(Welch, LeavesOutWhatIsNotFinite) {
  Render a = render(1, 1, none);
  const Render b = render(2, 1, none);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) a.image.values[static_cast<std::size_t>(3 * (y * side + x))] = NAN;
  const WelchTest test = welch_test(a.tested(), b.tested());
  EXPECT_EQ(test.tested, 1023u);
  EXPECT_TRUE(std::isnan(test.p_values[0]));
}

}  // namespace
}  // namespace vitrail::welch_tests
