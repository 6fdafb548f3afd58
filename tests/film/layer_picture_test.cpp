// SPDX-License-Identifier: Apache-2.0
#include "film/layer_picture.h"

#include <gtest/gtest.h>

#include <bit>

namespace vitrail::layer_picture_test {
namespace {

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

}  // namespace
}  // namespace vitrail::layer_picture_test
