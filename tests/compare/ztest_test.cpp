// SPDX-License-Identifier: Apache-2.0
#include "compare/ztest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/comparison.h"
#include "compare/variance.h"
#include "film/develop.h"
#include "scene/system/diagnostics.h"

namespace vitrail::ztest_test {
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
  return compare({&image, &grey, std::move(variance), {}}, Metric::ztest, std::nullopt);
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
  const ZTest t = ztest({&grey, &grey, std::vector<double>(grey.pixels(), 1), {}});
  EXPECT_NEAR(std::pow(1 - t.value_significance, side * side), 0.99, 1e-9);
}

TEST(ZTest, FailsABiasAndTooMuchNoise) {
  EXPECT_FALSE(test(noisy(0.1, 0.3, 1), 0.01).passed);
  EXPECT_FALSE(test(noisy(0.2, 0, 1), 0.01).passed);
}

// 2.5 % too dark is 5.8 standard errors of the mean, and a quarter of one in each pixel.
TEST(ZTest, FailsAMeanThatNoPixelShows) {
  const double sigma = 0.0125 * side / 5.8;
  int failed = 0;
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Comparison dark = test(noisy(sigma, -0.0125, seed), sigma * sigma);
    EXPECT_LE(dark.value, ztest_tolerated);
    EXPECT_NEAR(dark.test->mean_sigmas, 5.8, 3);
    failed += dark.passed ? 0 : 1;
    EXPECT_TRUE(test(noisy(sigma, 0, seed), sigma * sigma).passed);
    EXPECT_NEAR(dark.test->noise_rms, sigma, 1e-6 * sigma);
  }
  EXPECT_GE(failed, 4);
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

// All pixels 3 % too bright: 30 standard errors of independent pixels, 3 where all share an error of 1 %.
TEST(ZTest, KnowsAnErrorThatPixelsShare) {
  Image bright = grey;
  for (float& v : bright.values) v *= 1.03f;
  ZTestInput input{&bright, &grey, std::vector<double>(grey.pixels(), 0.05 * 0.05), {}};
  EXPECT_NEAR(ztest(input).mean_sigmas, 30, 1);
  EXPECT_TRUE(ztest(input).means_differ);
  input.shared_error = 0.01;
  EXPECT_NEAR(ztest(input).mean_sigmas, 3, 0.1);
  EXPECT_FALSE(ztest(input).means_differ);
  input.shared_error = 1e-5;
  EXPECT_NEAR(ztest(input).mean_sigmas, 30, 1) << "the larger of both counts";
  Image below = grey;
  for (float& v : below.values) v = -v;
  for (float& v : bright.values) v = -v;
  input.reference = &below;
  input.shared_error = 0.01;
  EXPECT_NEAR(ztest(input).mean_sigmas, 3, 0.1) << "of filters that go below zero";
}

TEST(ZTest, TakesPicturesOfOneSize) {
  const Image small{1, 1, 3, {0, 0, 0}};
  EXPECT_THROW(ztest({&small, &grey, {1}, {}}), Error);
}

TEST(ZTest, CountsNotANumberAsFailed) {
  Image image = grey;
  image.values[0] = std::numeric_limits<float>::quiet_NaN();
  const Comparison c = test(image, 1);
  EXPECT_EQ(c.value, 1.0 / (side * side));
  EXPECT_FALSE(c.passed);
}

// Samples of a luminance with mean `mean` and standard deviation `sigma`, both functions of the pixel.
template <class Mean, class Sigma>
Picture pictured(unsigned seed, std::uint32_t samples, Mean mean, Sigma sigma) {
  FilmSettings settings;
  settings.width = settings.height = side;
  settings.crop = {0, side, 0, side};
  Film film(settings, {});
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-std::sqrt(3.0), std::sqrt(3.0));  // of variance 1
  const XYZ white = srgb_to_xyz({1, 1, 1});
  for (std::uint32_t p = 0; p < side * side; ++p)
    for (std::uint32_t s = 0; s < samples; ++s) {
      const double y = mean(p) + sigma(p) * uniform(random);
      film.count_sample(p, s);
      film.deposit(p, s, {y * white.x, y * white.y, y * white.z});
    }
  return develop(film);
}

Comparison against_grey(const Picture& picture) {
  const EstimatedVariance own{&picture.variance, sample_groups - 1};
  PooledVariance known = pooled(std::span(&own, 1));
  return compare({&picture.rgb, &grey, known.variance, known.degrees_of_freedom}, Metric::ztest,
                 std::nullopt);
}

const auto half = [](std::uint32_t) { return 0.5; };
const auto one = [](std::uint32_t) { return 1.0; };

TEST(ZTest, HoldsForTheVarianceOfAFilm) {
  const Picture picture = pictured(7, 16, half, one);
  EXPECT_LE(against_grey(picture).value, 2e-4);
  const std::vector<float>& own = picture.variance.values;
  const ZTestInput alone{&picture.rgb, &grey, {own.begin(), own.end()}, std::vector<int>(own.size(), 1)};
  EXPECT_LE(compare(alone, Metric::ztest, std::nullopt).value, 2e-4);
  const ZTestInput normal{&picture.rgb, &grey, {own.begin(), own.end()}, {}};
  EXPECT_GT(compare(normal, Metric::ztest, std::nullopt).value, 1e-3);  // too many would fail
}

// Edges, and single pixels with a hundred times the variance of those around them.
TEST(ZTest, HoldsWhereVariancesDiffer) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const auto edges = [](std::uint32_t p) { return p % side < side / 2 ? 1.0 : 0.01; };
    EXPECT_TRUE(against_grey(pictured(seed, 16, half, edges)).passed);
    const auto spots = [](std::uint32_t p) { return p % 97 == 0 ? 1.0 : 0.1; };
    EXPECT_TRUE(against_grey(pictured(seed, 16, half, spots)).passed);
  }
}

// A twentieth of the pixels is off by eight standard errors of the mean: each by itself, with its one degree
// of freedom, would have to be off by a hundred thousand to be found.
TEST(ZTest, FindsABiasOfAFewStandardErrors) {
  const auto biased = [](std::uint32_t p) { return p % 20 == 0 ? 0.5 + 8 / std::sqrt(16.0) : 0.5; };
  const Picture picture = pictured(3, 16, biased, one);
  const Comparison found = against_grey(picture);
  EXPECT_FALSE(found.passed);
  EXPECT_GT(found.value, 0.035);
  EXPECT_LT(found.value, 0.0505);
}

TEST(PooledVariance, CountsDegreesOfFreedom) {
  const Image even{9, 9, 1, std::vector<float>(81, 2)};
  const EstimatedVariance part{&even, 3};
  const PooledVariance alone = pooled(std::span(&part, 1));
  EXPECT_EQ(alone.variance, std::vector<double>(81, 2));
  EXPECT_EQ(alone.degrees_of_freedom[40], 3 * 49);  // no more than 49 estimates have
  EXPECT_EQ(alone.degrees_of_freedom[0], 3 * 16);
  const std::vector<EstimatedVariance> two{part, part};
  EXPECT_EQ(pooled(two).variance, std::vector<double>(81, 4));
  EXPECT_EQ(pooled(two).degrees_of_freedom[40], 3 * 98);
  Image spot{9, 9, 1, std::vector<float>(81, 0)};
  spot.values[40] = 49;
  const EstimatedVariance single{&spot, 3};
  const PooledVariance lonely = pooled(std::span(&single, 1));
  EXPECT_EQ(lonely.variance[40], 49);
  EXPECT_EQ(lonely.variance[41], 1);
  EXPECT_EQ(lonely.degrees_of_freedom[40], 5);
}

}  // namespace
}  // namespace vitrail::ztest_test
