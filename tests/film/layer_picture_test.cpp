// SPDX-License-Identifier: Apache-2.0
#include "film/layer_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"

namespace vitrail::layer_picture_test {
namespace {

using ::testing::HasSubstr;

// Two pixels; of the first, things 7 and 9 cover a half and a quarter, of the second 9 an eighth.
Picture of_things() {
  const auto id = [](std::uint32_t number) { return std::bit_cast<float>(number); };
  Picture picture;
  picture.rgb = {2, 1, 3, {1, 1, 1, 1, 1, 1}};
  picture.layers = {{"Id.shape", true, {}, {7, 9}},
                    {"CryptoObject00.R", false, {id(7), id(9)}, {}},
                    {"CryptoObject00.G", false, {0.5f, 0.125f}, {}},
                    {"CryptoObject00.B", false, {id(9), id(0)}, {}},
                    {"CryptoObject00.A", false, {0.25f, 0}, {}}};
  return picture;
}

TEST(LayerPicture, ShowsAPixelInTheColoursOfWhatCoversItEachAsMuchAsItCovers) {
  Picture ids = of_things(), mattes = of_things();
  show_layer(ids, "shape_index", true);
  show_layer(mattes, "crypto_object", true);
  for (std::size_t c = 0; c < 3; ++c) {
    const float seven = ids.rgb.values[c], nine = ids.rgb.values[3 + c];
    EXPECT_NE(seven, nine) << c;
    EXPECT_FLOAT_EQ(mattes.rgb.values[c], 0.5f * seven + 0.25f * nine) << c;
    EXPECT_FLOAT_EQ(mattes.rgb.values[3 + c], 0.125f * nine) << c;
  }
}

TEST(LayerPicture, KeepsNumbersOfIdsWhereItIsNotForScreens) {
  Picture picture = of_things();
  show_layer(picture, "shape_index", false);
  EXPECT_EQ(picture.rgb.values, (std::vector<float>{7, 7, 7, 9, 9, 9}));
}

TEST(LayerPicture, ShowsNormalsEncodedAndLengthsRelativeToTheGreatest) {
  constexpr float far = std::numeric_limits<float>::infinity();
  const auto picture = [] {
    Picture p;
    p.rgb = {3, 1, 3, std::vector<float>(9, 1)};
    p.layers = {{"N.X", false, {-1, 0, 1}, {}},   {"N.Y", false, {0, 0, 0}, {}},
                {"N.Z", false, {1, 1, 1.5f}, {}}, {"Z", false, {0.25f, 0.5f, far}, {}},
                {"u", false, {0.25f, 2, 0}, {}},  {"v", false, {-1, 0, 3}, {}}};
    p.mattes = {{"CryptoObject", ""}};
    p.variance = {3, 1, 1, {1, 1, 1}};
    return p;
  };
  const auto values_of = [&](const char* name, bool shown) {
    Picture p = picture();
    show_layer(p, name, shown);
    EXPECT_TRUE(p.layers.empty() && p.mattes.empty() && p.variance.values.empty()) << name;
    return p.rgb.values;
  };
  const auto half = static_cast<float>(srgb_decode(0.5));
  EXPECT_EQ(values_of("geo_normal", true), (std::vector<float>{0, half, 1, half, half, 1, 1, half, 1}));
  EXPECT_EQ(values_of("geo_normal", false), (std::vector<float>{-1, 0, 1, 0, 0, 1, 1, 0, 1.5f}));
  EXPECT_EQ(values_of("depth", true), (std::vector<float>{0.5f, 0.5f, 0.5f, 1, 1, 1, far, far, far}));
  EXPECT_EQ(values_of("depth", false),
            (std::vector<float>{0.25f, 0.25f, 0.25f, 0.5f, 0.5f, 0.5f, far, far, far}));
  for (const bool shown : {false, true})
    EXPECT_EQ(values_of("uv", shown), (std::vector<float>{0.25f, -1, 0, 2, 0, 0, 0, 3, 0})) << "no length";
}

TEST(LayerPicture, SaysWhichLayersThereAre) {
  const auto message = [](Picture picture, const char* name) {
    try {
      show_layer(picture, name, true);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(of_things(), "depth"),
              HasSubstr("no layer depth; there is shape_index, crypto_object"));
  EXPECT_THAT(message({}, "depth"), HasSubstr("there is none: render with --aov"));
  EXPECT_THAT(message(of_things(), "colour"), HasSubstr("\"colour\" is none of albedo"));
}

}  // namespace
}  // namespace vitrail::layer_picture_test
