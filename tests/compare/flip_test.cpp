// SPDX-License-Identifier: Apache-2.0
// FLIP as its authors compute it: the expected numbers are those of their package flip-evaluator 1.7, of the
// images that `pattern` makes, by
//   flip_evaluator.evaluate(reference, image, "LDR" or "HDR", inputsRGB=False, applyMagma=False)
// which returns the map and its mean. It works in single precision.
#include "compare/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compare/comparison.h"
#include "compare/error_images.h"
#include "compare/metrics.h"
#include "scene/system/diagnostics.h"

namespace vitrail::flip_test {
namespace {

constexpr int width = 40, height = 30;
constexpr double tolerance = 2e-4;

// Waves of their own in each channel, and a finer one of the amplitude `fine`; `range` multiplies by e^−2 at
// the left to e^3 at the right.
Image pattern(double fine, bool range = false) {
  Image image = black_image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double v = 0.5 +
                         0.4 * std::sin(0.31 * x * (c + 1) + 0.17 * y) * std::cos(0.23 * y - 0.05 * c * x) +
                         fine * std::sin(0.9 * x + 1.3 * y + c);
        const double gain = range ? std::exp(-2 + 5 * x / (width - 1.0)) : 1;
        image.values[static_cast<std::size_t>(3 * (y * width + x) + c)] =
            static_cast<float>(std::max(0.0, v * gain));
      }
  return image;
}

double at(const std::vector<double>& map, int x, int y) {
  return map[static_cast<std::size_t>(y * width + x)];
}

TEST(Flip, OfImagesForScreensIsThatOfItsAuthors) {
  const std::vector<double> map = ldr_flip(pattern(0.1), pattern(0));
  EXPECT_NEAR(mean_of_valid(map), 0.08627594, tolerance);
  EXPECT_NEAR(at(map, 11, 7), 0.08658915, tolerance);
  EXPECT_NEAR(at(map, 0, 0), 0.23689789, tolerance);
  EXPECT_NEAR(at(map, 39, 29), 0.2523027, tolerance);
  EXPECT_NEAR(mean_of_valid(ldr_flip(pattern(0.02), pattern(0))), 0.02699793, tolerance);
}

TEST(Flip, DependsOnHowNearTheViewerIs) {
  const std::vector<double> map = ldr_flip(pattern(0.1), pattern(0), 20);
  EXPECT_NEAR(mean_of_valid(map), 0.30663541, tolerance);
  EXPECT_NEAR(at(map, 11, 7), 0.31682715, tolerance);
}

TEST(Flip, OfImagesOfAnyRangeIsThatOfItsAuthors) {
  const FlipExposures exposures = flip_exposures(pattern(0, true));
  EXPECT_NEAR(exposures.start_ev, -2.576230764, 1e-4);
  EXPECT_NEAR(exposures.stop_ev, 1.606050372, 2e-4);
  EXPECT_EQ(exposures.count, 5);
  const std::vector<double> map = hdr_flip(pattern(0.1, true), pattern(0, true));
  EXPECT_NEAR(mean_of_valid(map), 0.10380377, tolerance);
  EXPECT_NEAR(at(map, 11, 7), 0.07195046, tolerance);
  EXPECT_NEAR(at(map, 0, 0), 0.1739543, tolerance);
  EXPECT_NEAR(at(map, 39, 29), 0.1228775, tolerance);
}

TEST(Flip, OfEqualImagesIsZeroAndOfOppositesOne) {
  const Image image = pattern(0);
  for (const double e : hdr_flip(image, image)) EXPECT_EQ(e, 0);
  Image green = black_image(64, 64, 3), blue = green;
  for (std::size_t p = 0; p < green.pixels(); ++p) green.values[3 * p + 1] = blue.values[3 * p + 2] = 1;
  EXPECT_NEAR(mean_of_valid(ldr_flip(green, blue)), 1, 1e-6);
}

TEST(Flip, OfBlackAndOfAOnePixelImageIsANumber) {
  const Image black = black_image(1, 1, 3);
  EXPECT_EQ(hdr_flip(black, black).at(0), 0);
  Image lit = black;
  lit.values = {1, 1, 1};
  EXPECT_GT(hdr_flip(lit, black).at(0), 0.5);
}

TEST(Flip, PixelsThatAreNotFiniteAreLeftOutAndSpoilNoOthers) {
  Image bad = pattern(0.1);
  bad.values[3 * (15 * width + 20)] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<double> map = ldr_flip(bad, pattern(0));
  EXPECT_TRUE(std::isnan(at(map, 20, 15)));
  EXPECT_FALSE(std::isnan(at(map, 21, 15)));
  EXPECT_NEAR(mean_of_valid(map), 0.0863, 2e-3);
  EXPECT_THROW(ldr_flip(bad, black_image(3, 3, 3)), Error);
}

TEST(Flip, MagmaEndsAsPublished) {
  const std::vector<double> errors{0, 0.5, 1};
  const Image map = heatmap(errors, 3, 1, 1, Palette::magma);
  // matplotlib.colormaps["magma"] at 0, 1/2 and 1: (0, 0, 4), (183, 55, 121), (252, 253, 191) of 255, as
  // sRGB.
  const double expected[] = {0, 0, 4, 183, 55, 121, 252, 253, 191};
  for (std::size_t i = 0; i < 9; ++i) {
    const double v = 255 * (map.values[i] <= 0.0031308f
                                ? 12.92 * static_cast<double>(map.values[i])
                                : 1.055 * std::pow(static_cast<double>(map.values[i]), 1 / 2.4) - 0.055);
    EXPECT_NEAR(v, expected[i], 1.01) << i;
  }
}

}  // namespace
}  // namespace vitrail::flip_test
