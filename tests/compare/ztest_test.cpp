// SPDX-License-Identifier: Apache-2.0
#include "compare/ztest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/comparison.h"
#include "compare/variance.h"
#include "film/develop.h"

namespace vitrail {
namespace {

// From tables of Student's distribution.
TEST(TwoSidedP, KnownQuantiles) {
  EXPECT_NEAR(two_sided_p(1.959964, 0), 0.05, 1e-7);
  EXPECT_NEAR(two_sided_p(12.7062047, 1), 0.05, 1e-8);
  EXPECT_NEAR(two_sided_p(4.3026527, 2), 0.05, 1e-8);
  EXPECT_NEAR(two_sided_p(3.1824463, 3), 0.05, 1e-8);
  EXPECT_NEAR(two_sided_p(2.7764451, 4), 0.05, 1e-8);
  EXPECT_NEAR(two_sided_p(2.3646243, 7), 0.05, 1e-8);
  EXPECT_NEAR(two_sided_p(-3.4994833, 7), 0.01, 1e-8);
  EXPECT_EQ(two_sided_p(0, 7), 1);
}

constexpr int side = 100;
const Image grey{side, side, 3, std::vector<float>(3 * side * side, 0.5f)};

// The reference with noise of standard deviation σ and a bias.
Image noisy(double sigma, double bias, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(bias, sigma);
  Image image = grey;
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    const auto noise = static_cast<float>(normal(random));
    for (std::size_t c = 0; c < 3; ++c) image.values[3 * p + c] += noise;
  }
  return image;
}

Comparison test(const Image& image, std::vector<double> variance) {
  return compare({&image, &grey, std::move(variance), 0}, Metric::ztest, std::nullopt);
}
Comparison test(const Image& image, double variance) {
  return test(image, std::vector<double>(image.pixels(), variance));
}

TEST(ZTest, PassesNoiseOfTheVarianceGiven) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Comparison c = test(noisy(0.1, 0, seed), 0.01);
    EXPECT_TRUE(c.passed);
    EXPECT_LE(c.value * side * side, 1);  // 1 % chance of a single pixel
  }
}

TEST(ZTest, CorrectionIsSidaks) {
  const ZTest t = ztest({&grey, &grey, std::vector<double>(grey.pixels(), 1), 0});
  EXPECT_NEAR(std::pow(1 - t.value_significance, side * side), 0.99, 1e-9);
}

TEST(ZTest, FailsABiasAndTooMuchNoise) {
  EXPECT_FALSE(test(noisy(0.1, 0.3, 1), 0.01).passed);
  EXPECT_FALSE(test(noisy(0.2, 0, 1), 0.01).passed);
}

TEST(ZTest, ForgivesAHalfFloatsRoundingWithoutVariance) {
  Image image = grey;
  for (float& v : image.values) v *= 1 + 0x1p-12f;
  std::vector<double> rounding(image.pixels(), 0.0);
  add_rounding(rounding, grey);
  EXPECT_TRUE(test(image, rounding).passed);
  for (float& v : image.values) v *= 1.01f;
  EXPECT_FALSE(test(image, rounding).passed);
}

TEST(ZTest, CountsNotANumberAsFailed) {
  Image image = grey;
  image.values[0] = std::numeric_limits<float>::quiet_NaN();
  const Comparison c = test(image, 1);
  EXPECT_EQ(c.value, 1.0 / (side * side));
  EXPECT_FALSE(c.passed);
}

// The groups' variance has few degrees of freedom: with Student's distribution the right share of pixels
// passes.
TEST(ZTest, HoldsForTheVarianceOfAFilm) {
  FilmSettings settings;
  settings.width = settings.height = side;
  settings.crop = {0, side, 0, side};
  Film film(settings, {});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::uint32_t p = 0; p < side * side; ++p)
    for (std::uint32_t s = 0; s < 16; ++s) {
      const XYZ white = srgb_to_xyz({1, 1, 1});
      const double y = uniform(random);
      film.count_sample(p);
      film.deposit(p, s, {y * white.x, y * white.y, y * white.z});
    }
  const Picture picture = develop(film);
  const auto run = [&](int degrees_of_freedom) {
    return compare({&picture.rgb, &grey, luminance_variance(picture.variance), degrees_of_freedom},
                   Metric::ztest, std::nullopt);
  };
  EXPECT_LE(run(luminance_groups - 1).value, 2e-4);
  EXPECT_GT(run(0).value, 1e-3);  // taken for normal, too many would fail
}

}  // namespace
}  // namespace vitrail
