// SPDX-License-Identifier: Apache-2.0
#include "film/white_balance.h"

#include <gtest/gtest.h>

#include "scene/system/diagnostics.h"

namespace vitrail::white_balance_test {
namespace {

Picture picture_of(const RGB& c, float variance) {
  Picture picture;
  picture.rgb = black_image(1, 1, 3);
  picture.rgb.values = {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
  picture.variance = black_image(1, 1, 1);
  picture.variance.values = {variance};
  return picture;
}

// CIE 015:2018, tables 5 and 6, and the Planckian radiator that illuminant A is.
TEST(Daylight, HasCiesChromaticities) {
  struct Row {
    double kelvin, x, y;
  };
  for (const Row& r : {Row{5000, .34567, .35851}, Row{5500, .33243, .34744}, Row{6500, .31272, .32903},
                       Row{7500, .29903, .31488}, Row{2854.2, .44758, .40745}}) {
    const Chromaticity c = daylight(r.kelvin);
    EXPECT_NEAR(c.x, r.x, 1.2e-4) << r.kelvin;
    EXPECT_NEAR(c.y, r.y, 1.2e-4) << r.kelvin;
  }
  EXPECT_THROW(daylight(0), Error);
}

TEST(WhiteBalance, TakesItsWhiteToD65) {
  for (const double kelvin : {2800.0, 4000.0, 9000.0}) {
    const Chromaticity w = daylight(kelvin);
    Picture picture = picture_of(xyz_to_srgb({w.x / w.y, 1, (1 - w.x - w.y) / w.y}), 4);
    balance_white(picture, kelvin);
    for (const float c : picture.rgb.values) EXPECT_NEAR(c, 1, 1e-5) << kelvin;
    EXPECT_NEAR(picture.variance.values[0], 4, 1e-4) << kelvin;  // white keeps its luminance
  }
}

TEST(WhiteBalance, OfD65IsNone) {
  Picture picture = picture_of({.8, .2, .1}, 1);
  balance_white(picture, 6500);
  EXPECT_NEAR(picture.rgb.values[0], .8, 3e-4);
  EXPECT_NEAR(picture.rgb.values[1], .2, 3e-4);
  EXPECT_NEAR(picture.rgb.values[2], .1, 3e-4);
}

// Bradford's by hand, of XYZ (.5, .4, .2) from 5000 K.
TEST(WhiteBalance, ChangesVariancesAsLuminances) {
  Picture picture = picture_of(xyz_to_srgb({.5, .4, .2}), 1);
  balance_white(picture, 5000);
  const auto& v = picture.rgb.values;
  const double y =
      srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}).y;
  EXPECT_NEAR(y, .3940, 2e-4);
  EXPECT_NEAR(picture.variance.values[0], y * y / .16, 1e-5);
}

}  // namespace
}  // namespace vitrail::white_balance_test
