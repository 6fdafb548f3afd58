// SPDX-License-Identifier: Apache-2.0
#include "film/false_color.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/daylight/photometry.h"
#include "scene/spectra/color.h"

namespace vitrail::false_color_test {
namespace {

Image picture_of(std::initializer_list<double> luminances) {
  Image image = black_image(static_cast<int>(luminances.size()), 1, 3);
  std::size_t i = 0;
  for (const double l : luminances)
    for (int c = 0; c < 3; ++c) image.values[i++] = static_cast<float>(l / photometric(1));
  return image;
}

std::array<int, 3> shown(const Image& image, int x) {
  std::array<int, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<int>(std::lround(
        255 * srgb_encode(static_cast<double>(image.values[static_cast<std::size_t>(3 * x) + c]))));
  return color;
}

using Color = std::array<int, 3>;
constexpr Color darkest{68, 1, 84}, brightest{253, 231, 37}, third{49, 104, 142};

TEST(FalseColor, EndsAreThePalettes) {
  const Image image = false_colored(picture_of({0, 300, 100, 5000}), {300, false});
  EXPECT_EQ(shown(image, 0), darkest);
  EXPECT_EQ(shown(image, 1), brightest);
  EXPECT_EQ(shown(image, 2), third);
  EXPECT_EQ(shown(image, 3), brightest);
  EXPECT_GT(image.width, 4);  // the scale
  EXPECT_GT(image.height, 1);
}

TEST(FalseColor, LogarithmsAreOfThreeDecades) {
  const Image image = false_colored(picture_of({0, 1, 10, 1000}), {1000, true});
  EXPECT_EQ(shown(image, 0), darkest);
  EXPECT_EQ(shown(image, 1), darkest);
  EXPECT_EQ(shown(image, 2), third);
  EXPECT_EQ(shown(image, 3), brightest);
}

TEST(FalseColor, FindsARoundEnd) {
  EXPECT_DOUBLE_EQ(round_above(1.7), 2);
  EXPECT_DOUBLE_EQ(round_above(2), 2);
  EXPECT_DOUBLE_EQ(round_above(0.051), 0.1);
  EXPECT_DOUBLE_EQ(round_above(20001), 50000);
  EXPECT_EQ(shown(false_colored(picture_of({190, 190, 190, 190}), {}), 0),
            shown(false_colored(picture_of({190}), {200, false}), 0));
  // Of less than 1 cd/m², and of none: then the end is 1.
  EXPECT_EQ(false_colored(picture_of({0.019, 0.019}), {}),
            false_colored(picture_of({0.019, 0.019}), {0.02, false}));
  EXPECT_EQ(false_colored(picture_of({0, 0}), {}), false_colored(picture_of({0, 0}), {1, false}));
}

}  // namespace
}  // namespace vitrail::false_color_test
