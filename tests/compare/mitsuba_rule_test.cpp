// SPDX-License-Identifier: Apache-2.0
// The z-test of X, Y and Z with the variances of Mitsuba's references, and comparisons of parts of images.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compare/comparison.h"
#include "compare/mask.h"
#include "compare/variance.h"
#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"

namespace vitrail::mitsuba_rule_test {
namespace {

constexpr int side = 48, samples = 868;

// As Mitsuba writes a triple of X, Y and Z.
Image written(const std::vector<XYZ>& values) {
  Image image = black_image(static_cast<int>(values.size()), 1, 3);
  for (std::size_t p = 0; p < values.size(); ++p) {
    const RGB c = xyz_to_srgb(values[p]);
    image.values[3 * p] = static_cast<float>(c.r);
    image.values[3 * p + 1] = static_cast<float>(c.g);
    image.values[3 * p + 2] = static_cast<float>(c.b);
  }
  return image;
}

// A picture of `samples` a pixel whose single samples have the variance `of_sample`, and its reference.
struct Pictures {
  Image image, reference, variance;
};
Pictures pictures(XYZ of_sample, double bias_of_z, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const XYZ mean{0.5, 0.4, 0.3};
  std::vector<XYZ> noisy;
  for (int p = 0; p < side * side; ++p) {
    const auto noise = [&](double variance) { return std::sqrt(variance / samples) * normal(random); };
    noisy.push_back({mean.x + noise(of_sample.x), mean.y + noise(of_sample.y),
                     mean.z * (1 + bias_of_z) + noise(of_sample.z)});
  }
  const std::vector<XYZ> flat(noisy.size(), mean), variances(noisy.size(), of_sample);
  return {written(noisy), written(flat), written(variances)};
}

Comparison by_mitsubas_rule(const Pictures& p, double mean_within = 0.01) {
  return compare({&p.image, &p.reference, mitsuba_variance(p.variance, samples), {}}, Metric::ztest,
                 std::nullopt, mean_within);
}

TEST(MitsubaVariance, IsOfXyzWhateverItsRgb) {
  const Image variance = written({{0.2, 0.1, 2}, {0, 0, 0}});
  EXPECT_LT(variance.values[0], 0);  // no variance of red: a triple like any other
  const std::vector<double> of_mean = mitsuba_variance(variance, 100);
  EXPECT_NEAR(of_mean[0], 0.002, 1e-9);
  EXPECT_NEAR(of_mean[1], 0.001, 1e-9);
  EXPECT_NEAR(of_mean[2], 0.02, 1e-8);
  for (std::size_t c = 3; c < 6; ++c) EXPECT_EQ(of_mean[c], 1e-6);
}

TEST(MitsubaVariance, WidensWhereTheImageHasMore) {
  std::vector<double> variance{1, 2, 3, 1, 2, 3};
  EXPECT_EQ(widen(variance, {1.9, 6}), 1u);
  EXPECT_EQ(variance, (std::vector<double>{1, 2, 3, 3, 6, 9}));
}

TEST(MitsubaRule, PassesASampleOfTheReference) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Comparison c = by_mitsubas_rule(pictures({0.2, 0.1, 2}, 0, seed));
    EXPECT_TRUE(c.passed);
    EXPECT_LE(c.value * 3 * side * side, 2);
  }
}

TEST(MitsubaRule, FailsABiasOfOneChannel) {
  EXPECT_FALSE(by_mitsubas_rule(pictures({0.2, 0.1, 0.1}, 0.3, 1)).passed);
}

// What the z-test forgives, since each pixel is noisy, the mean of all shows.
TEST(MitsubaRule, MeansWithinAPercentSeeWhatThePixelsForgive) {
  const Pictures biased = pictures({0.2, 0.1, 0.1}, 0.03, 1);
  const Comparison c = by_mitsubas_rule(biased);
  EXPECT_LE(c.value, ztest_tolerated);
  EXPECT_NEAR(c.ratios.z, 1.03, 0.005);
  EXPECT_FALSE(c.passed);
  EXPECT_TRUE(by_mitsubas_rule(biased, 0.05).passed);
}

TEST(Mask, LeavesOutRectanglesAndBlackPixels) {
  const Image kept{3, 2, 1, {1, 0, 1, 1, 1, 1}};
  const PixelRect corner{2, 3, 1, 2};
  const Mask mask = make_mask(3, 2, std::span(&corner, 1), kept);
  EXPECT_EQ(mask, (Mask{false, true, false, false, false, true}));
  const Image part = without(Image{3, 2, 1, {0, 1, 2, 3, 4, 5}}, mask);
  EXPECT_EQ(part, (Image{4, 1, 1, {0, 2, 3, 4}}));
  EXPECT_EQ(spread({1, 2, 3, 4}, mask), (std::vector<double>{1, 0, 2, 3, 4, 0}));
  EXPECT_EQ(without(std::vector<double>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}, mask),
            (std::vector<double>{0, 0, 2, 2, 3, 3, 4, 4}));
}

TEST(Mask, RectanglesEndBeforeTheirLastRowAndColumn) {
  const PixelRect first{0, 1, 0, 1};
  EXPECT_EQ(make_mask(2, 2, std::span(&first, 1), {}), (Mask{true, false, false, false}));
}

TEST(Mask, RefusesWhatDoesNotFit) {
  const PixelRect outside{0, 4, 0, 1}, all{0, 3, 0, 2};
  EXPECT_THROW(make_mask(3, 2, std::span(&outside, 1), {}), Error);
  EXPECT_THROW(make_mask(3, 2, std::span(&all, 1), {}), Error);
  EXPECT_THROW(make_mask(3, 2, {}, black_image(2, 2, 1)), Error);
}

}  // namespace
}  // namespace vitrail::mitsuba_rule_test
