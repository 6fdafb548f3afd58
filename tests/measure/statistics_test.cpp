// SPDX-License-Identifier: Apache-2.0
// Noise and bias of pictures whose noise and bias are known.
#include "measure/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "compare/flip.h"
#include "compare/metrics.h"
#include "scene/system/diagnostics.h"

namespace vitrail::statistics_test {
namespace {

constexpr int size = 32;
constexpr float truth = 0.5f;
constexpr double weight = 1 / (0.25 + 0.01);  // relMSE's

Image noisy(unsigned seed, double sigma, double bias = 0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(truth + bias, sigma);
  Image image = black_image(size, size, 3);
  for (float& v : image.values) v = static_cast<float>(normal(generator));
  return image;
}

std::vector<Image> pictures(unsigned first_seed, double sigma, double bias) {
  std::vector<Image> all;
  for (unsigned i = 0; i < 6; ++i) all.push_back(noisy(first_seed + i, sigma, bias));
  return all;
}

TEST(Statistics, KeepNoiseAndBiasApart) {
  constexpr double sigma = 0.2, bias = 0.04;
  const Reference reference = make_reference(noisy(1001, 0.02), noisy(1002, 0.02));
  const ErrorStatistics s = error_statistics(pictures(1, sigma, bias), reference);
  EXPECT_NEAR(s.noise.value, sigma * sigma * weight, 0.03 * sigma * sigma * weight);
  EXPECT_NEAR(s.bias.value, bias * bias * weight, 2e-3);
  EXPECT_NEAR(s.relmse.value, s.noise.value + s.bias.value, 1e-9);
  EXPECT_LT(std::abs(s.bias.value - bias * bias * weight), 2 * s.bias.half_width);
  EXPECT_TRUE(s.is_biased());
  EXPECT_NEAR(s.luminance.value, bias / truth, 0.01);
}

// FLIP of each picture is mostly noise, of their mean it is less.
TEST(Statistics, FlipIsOfEachPictureAndOfTheirMean) {
  const Reference reference = make_reference(noisy(1001, 0.02), noisy(1002, 0.02));
  const std::vector<Image> all = pictures(1, 0.2, 0);
  const ErrorStatistics s = error_statistics(all, reference);
  double sum = 0;
  Image mean = black_image(size, size, 3);
  for (const Image& picture : all) {
    sum += mean_of_valid(hdr_flip(picture, reference.mean));
    for (std::size_t i = 0; i < mean.values.size(); ++i) mean.values[i] += picture.values[i] / 6;
  }
  EXPECT_NEAR(s.flip.value, sum / 6, 1e-9);
  EXPECT_NEAR(s.flip_of_mean, mean_of_valid(hdr_flip(mean, reference.mean)), 1e-4);
  EXPECT_LT(s.flip_of_mean, s.flip.value);
}

TEST(Statistics, SeeNoBiasWhereThereIsNone) {
  const Reference reference = make_reference(noisy(1001, 0.1), noisy(1002, 0.1));
  int seen = 0;
  for (unsigned trial = 0; trial < 40; ++trial)
    seen += error_statistics(pictures(10 * trial + 1, 0.4, 0), reference).is_biased() ? 1 : 0;
  EXPECT_LE(seen, 6);  // one in 40 is expected; 7 or more come once in 30,000 times
}

// A reference that is itself noisy adds its noise to no error, and says how much it has.
TEST(Statistics, TakeOutTheReferencesOwnNoise) {
  const Reference coarse = make_reference(noisy(1001, 0.1), noisy(1002, 0.1));
  EXPECT_NEAR(coarse.relmse, 0.1 * 0.1 / 2 * weight, 0.1 * coarse.relmse);
  const double of_mean = error_statistics(pictures(1, 0.1, 0), coarse).relmse.value;
  const Reference fine = make_reference(noisy(1003, 1e-3), noisy(1004, 1e-3));
  EXPECT_NEAR(of_mean, error_statistics(pictures(1, 0.1, 0), fine).relmse.value, 0.005);
}

// What two settings' pictures of a seed have in common is not taken for a part of the bias.
TEST(Statistics, SeeTheBiasThatIsLessThanTheNoise) {
  constexpr double sigma = 0.4, bias = 0.01;
  const Reference reference = make_reference(noisy(1001, 0.1), noisy(1002, 0.1));
  const std::vector<Image> off = pictures(1, sigma, bias), unbiased = pictures(1, sigma, 0);
  const Estimate alone = error_statistics(off, reference).bias,
                 beside = error_statistics(off, reference, unbiased).bias;
  EXPECT_GT(alone.half_width, bias * bias * weight);
  EXPECT_NEAR(beside.value, bias * bias * weight, 0.1 * bias * bias * weight);
  EXPECT_LT(beside.half_width, 0.1 * bias * bias * weight);
  const Estimate none = error_statistics(unbiased, reference, unbiased).bias;
  EXPECT_EQ(none.value, 0);
  EXPECT_EQ(none.half_width, 0);
}

TEST(Statistics, BiasThatWasNotSeenMayStillBe) {
  EXPECT_EQ(expected_bias({0.5, 0}), 0.5);
  EXPECT_EQ(expected_bias({-0.5, 0}), 0);
  EXPECT_NEAR(expected_bias({0, 1.96}), std::sqrt(2 / std::numbers::pi), 1e-6);  // of a half normal
  EXPECT_NEAR(expected_bias({10, 1.96}), 10, 1e-6);
  EXPECT_NEAR(expected_bias({-10, 1.96}), 0.09809, 1e-4);  // φ(10)/Q(10) − 10
  double last = 0;
  for (const double value : {-40.0, -10.0, -5.1, -4.9, -1.0, 0.0, 1.0, 5.0}) {
    EXPECT_GT(expected_bias({value, 1.96}), last) << value;
    last = expected_bias({value, 1.96});
  }
}

TEST(Statistics, ReferencesAreOfOneSize) {
  EXPECT_THROW(make_reference(noisy(1, 0.1), black_image(1, 1, 3)), Error);
}

TEST(Statistics, IntervalsAreStudents) {
  const double values[] = {1, 2, 3, 4};
  const Estimate e = mean_of(values);
  EXPECT_DOUBLE_EQ(e.value, 2.5);
  EXPECT_NEAR(e.half_width, 3.182446 * std::sqrt(5.0 / 3 / 4), 1e-4);
  EXPECT_TRUE(std::isinf(mean_of(std::span(values, 1)).half_width));
}

}  // namespace
}  // namespace vitrail::statistics_test
