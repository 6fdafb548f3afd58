// SPDX-License-Identifier: Apache-2.0
#include "film/picture_extent.h"

#include <gtest/gtest.h>

#include <numeric>

#include "film/layer_picture.h"
#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"

namespace vitrail::picture_extent_test {
namespace {

// R is x, G is y, B is 1; and an id of each pixel.
Picture ramp(int width, int height) {
  Picture p;
  p.layers = {{"Z", false, {}, {}}, {"Id.shape", true, {}, {}}};
  p.rgb = {width, height, 3, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      for (const int v : {x, y, 1}) p.rgb.values.push_back(static_cast<float>(v));
      p.layers[0].values.push_back(static_cast<float>(x));
      p.layers[1].ids.push_back(static_cast<std::uint32_t>(y * width + x + 1));
    }
  p.variance = black_image(width, height, 1);
  p.window = {0, width, 0, height};
  p.full_width = width, p.full_height = height;
  return p;
}

TEST(PictureExtent, APartIsThatOfAllLayers) {
  Picture p = ramp(4, 3);
  cut_to(p, {1, 3, 1, 3});
  EXPECT_EQ(p.rgb.values, (std::vector<float>{1, 1, 1, 2, 1, 1, 1, 2, 1, 2, 2, 1}));
  EXPECT_EQ(p.layers[0].values, (std::vector<float>{1, 2, 1, 2}));
  EXPECT_EQ(p.layers[1].ids, (std::vector<std::uint32_t>{6, 7, 10, 11}));
  EXPECT_EQ(p.variance.pixels(), 4u);
  cut_to(p, {2, 3, 1, 2});
  EXPECT_EQ(p.rgb.values, (std::vector<float>{2, 1, 1}));
}

// A tent of radius 2 about the middle of two pixels: weights 1/8, 3/8, 3/8, 1/8, but at the border.
TEST(PictureExtent, HalfTheSizeIsMeansByATent) {
  Picture p = ramp(8, 8);
  resize(p, 4, 4);
  EXPECT_EQ(p.rgb.width, 4);
  EXPECT_EQ(p.full_width, 4);
  EXPECT_EQ(p.variance.pixels(), 0u);
  const auto at = [&](std::size_t x, std::size_t y, std::size_t c) {
    return p.rgb.values[3 * (4 * y + x) + c];
  };
  EXPECT_FLOAT_EQ(at(1, 2, 0), 2.5f);
  EXPECT_FLOAT_EQ(at(1, 2, 1), 4.5f);
  EXPECT_FLOAT_EQ(at(0, 0, 0), (0 * 3 + 1 * 3 + 2 * 1) / 7.0f);
  for (std::size_t i = 2; i < p.rgb.values.size(); i += 3) EXPECT_FLOAT_EQ(p.rgb.values[i], 1);
  EXPECT_FLOAT_EQ(p.layers[0].values[1], 2.5f);
  EXPECT_EQ(p.layers[1].ids[5], 8u * 3 + 3 + 1);
}

TEST(PictureExtent, LargerIsLinearBetweenPixels) {
  Picture p = ramp(4, 1);
  resize(p, 8, 3);
  const std::vector<float> expected{0, 0.25f, 0.75f, 1.25f, 1.75f, 2.25f, 2.75f, 3};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t x = 0; x < 8; ++x) EXPECT_FLOAT_EQ(p.rgb.values[3 * (8 * row + x)], expected[x]);
  Picture same = ramp(5, 7);
  resize(same, 5, 7);
  EXPECT_EQ(same.rgb, ramp(5, 7).rgb);
}

TEST(LayerPicture, ShowsNumbersAsTheyAreOrForScreens) {
  Picture raw = ramp(4, 1), shown = raw;
  show_layer(raw, "depth", false);
  EXPECT_EQ(raw.rgb.values, (std::vector<float>{0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3}));
  show_layer(shown, "depth", true);
  EXPECT_FLOAT_EQ(shown.rgb.values[3], 1 / 3.0f);
  Picture normals = ramp(1, 1);
  normals.layers = {{"Ns.X", false, {-1}, {}}, {"Ns.Y", false, {0}, {}}, {"Ns.Z", false, {1}, {}}};
  show_layer(normals, "normal", true);
  EXPECT_FLOAT_EQ(normals.rgb.values[0], 0);
  EXPECT_NEAR(srgb_encode(static_cast<double>(normals.rgb.values[1])), 0.5, 1e-6);
  EXPECT_FLOAT_EQ(normals.rgb.values[2], 1);
  Picture ids = ramp(2, 1);
  ids.layers[1].ids = {0, 5};
  show_layer(ids, "shape_index", true);
  EXPECT_EQ(ids.rgb.values[0] + ids.rgb.values[1] + ids.rgb.values[2], 0);
  EXPECT_GT(ids.rgb.values[3] + ids.rgb.values[4] + ids.rgb.values[5], 0.1f);
  Picture without = ramp(2, 1);
  EXPECT_THROW(show_layer(without, "albedo", true), Error);
  EXPECT_THROW(show_layer(without, "colour", true), Error);
}

}  // namespace
}  // namespace vitrail::picture_extent_test
