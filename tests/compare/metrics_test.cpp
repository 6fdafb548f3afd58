// SPDX-License-Identifier: Apache-2.0
#include "compare/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "compare/comparison.h"
#include "compare/error_images.h"
#include "scene/system/diagnostics.h"

namespace vitrail::metrics_test {
namespace {

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
  const std::vector<WorstPixel> worst = worst_pixels({0, 2, 3, nan}, a, a, 10, 20, 2);
  ASSERT_EQ(worst.size(), 2u);
  EXPECT_EQ(std::pair(worst[0].x, worst[0].y), std::pair(11, 21)) << "what is not a number";
  EXPECT_EQ(std::pair(worst[1].x, worst[1].y), std::pair(10, 21));
  EXPECT_EQ(worst[1].image[0], 3);
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
