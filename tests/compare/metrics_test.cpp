// SPDX-License-Identifier: Apache-2.0
#include "compare/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/error_images.h"
#include "scene/system/diagnostics.h"

namespace vitrail::metrics_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

const Image reference{2, 1, 3, {1, 1, 1, 0, 0, 0}};
const Image image{2, 1, 3, {1.5f, 1, 1, 0, 0.2f, 0}};

double value(Metric metric, const Image& a = image, const Image& b = reference) {
  return compare({&a, &b, {}, {}}, metric, std::nullopt).value;
}

TEST(Metrics, KnownValues) {
  EXPECT_NEAR(value(Metric::mse), (0.25 + 0.04) / 6, 1e-8);
  EXPECT_NEAR(value(Metric::mae), 0.7 / 6, 1e-8);
  EXPECT_NEAR(value(Metric::relmse), (0.25 / 1.01 + 0.04 / 0.01) / 6, 1e-6);
  EXPECT_NEAR(value(Metric::psnr), 10 * std::log10(6 / 0.29), 1e-6);
  EXPECT_NEAR(value(Metric::smape), (2 * 0.5 / 2.5 + 2.0) / 6, 1e-7);
  EXPECT_EQ(value(Metric::bitwise), 1);
}

TEST(Metrics, EqualImagesAreAtZero) {
  for (const Metric m : {Metric::mse, Metric::mae, Metric::relmse, Metric::smape, Metric::bitwise})
    EXPECT_EQ(value(m, image, image), 0);
  EXPECT_EQ(value(Metric::psnr, image, image), std::numeric_limits<double>::infinity());
}

TEST(Metrics, BitwiseSeesTheLastBitAndTheSignOfZero) {
  Image other = reference;
  other.values[0] = std::nextafter(1.0f, 2.0f);
  EXPECT_EQ(value(Metric::bitwise, other), 0.5);
  other = reference;
  other.values[5] = -0.0f;
  EXPECT_EQ(value(Metric::bitwise, other), 0.5);
  EXPECT_EQ(value(Metric::mse, other), 0);
}

TEST(Metrics, RatiosAreOfTheMeans) {
  const MeanRatios r = mean_ratios(image, reference);
  EXPECT_NEAR(r.red, 1.5, 1e-7);
  EXPECT_NEAR(r.green, 1.2, 1e-7);
  EXPECT_NEAR(r.blue, 1, 1e-7);
  EXPECT_NEAR(r.luminance, 1.5 * 0.2126 + 1.2 * 0.7152 + 0.0722, 1e-3);
  EXPECT_TRUE(std::isnan(mean_ratios(image, black_image(2, 1, 3)).red));
}

// Greys 1 and 3, of which the image has 0.4 more and 0.4 less: the difference scatters by 0.4 about a mean
// of 2.
TEST(Metrics, LuminanceRatioErrorIsThatOfTheMeanDifference) {
  const Image greys{2, 1, 3, {1, 1, 1, 3, 3, 3}}, other{2, 1, 3, {1.4f, 1.4f, 1.4f, 2.6f, 2.6f, 2.6f}},
      brighter{2, 1, 3, {1.4f, 1.4f, 1.4f, 3.4f, 3.4f, 3.4f}};
  EXPECT_NEAR(luminance_ratio_error(other, greys), 0.4 / std::sqrt(2) / 2, 1e-7);
  EXPECT_NEAR(luminance_ratio_error(other, greys, 4), 2 * 0.4 / std::sqrt(2) / 2, 1e-7);
  EXPECT_NEAR(luminance_ratio_error(brighter, greys), 0, 1e-7);
  EXPECT_TRUE(std::isnan(luminance_ratio_error(greys, black_image(2, 1, 3))));
}

TEST(Comparison, NonFinitePixelsAreLeftOutCountedAndFail) {
  Image bad = image;
  bad.values[1] = nan;
  const Comparison c = compare({&bad, &reference, {}, {}}, Metric::mse, std::nullopt);
  EXPECT_NEAR(c.value, 0.04 / 3, 1e-8);
  EXPECT_EQ(c.nonfinite_image, 1u);
  EXPECT_EQ(c.nonfinite_reference, 0u);
  EXPECT_FALSE(c.passed);
  EXPECT_FALSE(compare({&reference, &bad, {}, {}}, Metric::bitwise, 1.0).passed);
}

TEST(Comparison, ThresholdDecides) {
  EXPECT_TRUE(compare({&image, &reference, {}, {}}, Metric::mae, 0.12).passed);
  EXPECT_FALSE(compare({&image, &reference, {}, {}}, Metric::mae, 0.11).passed);
  EXPECT_FALSE(compare({&image, &reference, {}, {}}, Metric::bitwise, std::nullopt).passed);
}

TEST(Comparison, SizesMustAgree) {
  const Image larger = black_image(3, 1, 3);
  for (const std::string& name : metric_names())
    EXPECT_THROW(compare({&image, &larger, {0, 0, 0}, {}}, *metric_of(name), std::nullopt), Error) << name;
}

TEST(Comparison, JsonIsFlat) {
  const auto json = nlohmann::json::parse(to_json(compare({&image, &reference, {}, {}}, Metric::mae, 0.5)));
  EXPECT_EQ(json["metric"], "mae");
  EXPECT_EQ(json["passed"], true);
  EXPECT_EQ(json["threshold"], 0.5);
  EXPECT_EQ(json["pixels"], 2);
  for (const auto& entry : json) EXPECT_TRUE(entry.is_primitive());
}

TEST(Comparison, NamesTheWorstPixels) {
  const Image a = {2, 2, 3, {1, 1, 1, 2, 2, 2, 3, 3, 3, nan, 1, 1}};
  const Image b = {2, 2, 3, {1, 1, 1, 2, 2, 2, 5, 6, 7, 8, 1, 1}};
  const std::vector<WorstPixel> worst = worst_pixels({0, 2, 3, nan}, a, b, 10, 20, 2);
  ASSERT_EQ(worst.size(), 2u);
  EXPECT_EQ(std::pair(worst[0].x, worst[0].y), std::pair(11, 21)) << "what is not a number";
  EXPECT_EQ(std::pair(worst[1].x, worst[1].y), std::pair(10, 21));
  EXPECT_THAT(worst[1].image, ElementsAre(3, 3, 3));
  EXPECT_THAT(worst[1].reference, ElementsAre(5, 6, 7));
  EXPECT_EQ(worst[1].error, 3);
}

TEST(Comparison, WordsCountPixelsThatAreNotFinite) {
  Comparison c;
  EXPECT_THAT(to_text(c), Not(HasSubstr("not finite")));
  c.nonfinite_reference = 2;
  EXPECT_THAT(to_text(c), HasSubstr("pixels that are not finite: 0 of the image, 2 of the reference\n"));
}

TEST(Comparison, WordsSayWithinWhatTheMeansAre) {
  Comparison c;
  EXPECT_THAT(to_text(c), Not(HasSubstr("(X, Y, Z within")));
  c.mean_within = 0.25;
  EXPECT_THAT(to_text(c), HasSubstr("(X, Y, Z within 0.25)\n"));
}

// 5² = 3² + 4².
TEST(Comparison, WordsAndJsonPartNoiseFromTheRest) {
  Comparison c;
  c.test = ZTest{.mean_sigmas = 1.5, .noise_rms = 3, .difference_rms = 5};
  c.welch = WelchTest{.tested = 6, .histogram = {1, 2, 3}};
  EXPECT_THAT(to_text(c), HasSubstr("luminance differs by 5 rms: 3 is noise, 4 is not\n"));
  EXPECT_THAT(to_text(c), HasSubstr("the means differ by 1.5 standard errors\n"));
  EXPECT_THAT(to_text(c), HasSubstr("p-values of 6 tiles"));
  const auto json = nlohmann::json::parse(to_json(c));
  EXPECT_EQ(json["mean_sigmas"], 1.5);
  EXPECT_EQ(json["noise_rms"], 3);
  EXPECT_EQ(json["difference_rms"], 5);
  EXPECT_EQ(json["tiles"], 6);
  EXPECT_EQ(json["histogram"], (std::vector{1, 2, 3, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Comparison, IsOnlyJudgedWhereThereIsAThreshold) {
  const Comparison none = compare({&image, &reference, {}, {}}, Metric::mae, std::nullopt);
  EXPECT_THAT(to_text(none), Not(HasSubstr("passed")));
  EXPECT_TRUE(nlohmann::json::parse(to_json(none))["passed"].is_null());
  EXPECT_THAT(to_text(compare({&image, &reference, {}, {}}, Metric::mae, 1)), HasSubstr("passed"));
  EXPECT_THAT(to_text(compare({&image, &reference, {}, {}}, Metric::mae, 0.01)), HasSubstr("failed"));
}

TEST(Metrics, RmseIsTheRootOfMse) {
  EXPECT_NEAR(value(Metric::rmse, image), std::sqrt(value(Metric::mse, image)), 1e-15);
}

TEST(ErrorImages, SignsAreBlueAndRed) {
  const Image difference{3, 1, 3, {-2, -2, -2, 0, 0, 0, 1, 1, 1}};
  const std::vector<float> expected{0, 0, 1, 1, 1, 1, 1, 0.5f, 0.5f};
  EXPECT_THAT(signed_map(difference, 2).values, testing::Pointwise(testing::FloatNear(1e-6f), expected));
}

TEST(ErrorImages, LegendsGoBelow) {
  const Image wide = with_legend(black_image(100, 10, 3), 0.25, Palette::heat);
  EXPECT_EQ(wide.width, 100);
  EXPECT_GT(wide.height, 10);
  EXPECT_EQ(with_legend(black_image(8, 8, 3), 1, Palette::heat).height, 8);
}

TEST(ErrorImages, TheHottestIsThe99thPercentileOfNumbers) {
  std::vector<double> errors{std::numeric_limits<double>::quiet_NaN()};
  for (int i = 0; i <= 200; ++i) errors.push_back(200 - i);
  EXPECT_EQ(hottest(errors), 198);
  EXPECT_EQ(hottest({0, 0, 3, 0}), 3) << "the greatest, where the percentile is 0";
  EXPECT_EQ(hottest({std::numeric_limits<double>::quiet_NaN()}), 0);
}

TEST(ErrorImages, LegendsKeepTheImage) {
  Image wide = black_image(64, 2, 3);
  for (std::size_t i = 0; i < wide.values.size(); ++i) wide.values[i] = static_cast<float>(i);
  const Image whole = with_legend(wide, 1, Palette::heat);
  EXPECT_TRUE(std::equal(wide.values.begin(), wide.values.end(), whole.values.begin()));
}

TEST(ErrorImages, LegendsWriteTheGreatestErrorToTheRight) {
  const Image wide = with_legend(black_image(64, 1, 3), 0.5, Palette::heat);
  const auto line = [&](int y, int x0, int x1) {
    std::string text;
    for (int x = x0; x < x1; ++x)
      text += wide.values[static_cast<std::size_t>(3 * (64 * y + x))] > 0 ? '#' : '.';
    return text;
  };
  const std::vector<std::string> zero{".###.", ".#.#.", ".#.#.", ".#.#.", ".###."},
      half{".###.....###.", ".#.#.....#...", ".#.#.....###.", ".#.#.......#.", ".###..#..###."};
  for (int y = 0; y < 5; ++y) {
    EXPECT_EQ(line(10 + y, 0, 5), zero[static_cast<std::size_t>(y)]);
    EXPECT_EQ(line(10 + y, 51, 64), half[static_cast<std::size_t>(y)]);
  }
}

TEST(Heatmap, IsBlackWithoutErrorWhiteAtTheMostAndMagentaWithoutNumber) {
  std::vector<double> errors{0, 1, 0.5, std::numeric_limits<double>::quiet_NaN()};
  for (int i = 0; i < 4; ++i) errors.push_back(1);
  EXPECT_EQ(hottest(errors), 1);
  const Image heat = heatmap(errors, 8, 1, 1);
  EXPECT_EQ((std::vector<float>(heat.values.begin(), heat.values.begin() + 12)),
            (std::vector<float>{0, 0, 0, 1, 1, 1, 1, 0.5f, 0, 1, 0, 1}));
}

}  // namespace
}  // namespace vitrail::metrics_test
