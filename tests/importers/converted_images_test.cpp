// SPDX-License-Identifier: Apache-2.0
#include "importers/images/converted_images.h"

#include <gmock/gmock.h>

#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::converted_images_test {
namespace {

using testing::ElementsAre;

class ImagesBeside : public testing::Test {
 protected:
  ImagesBeside() {
    Image image = black_image(2, 2, 1);
    image.values = {1, 2, 3, 4};
    write_exr_image(folder_ / "a.exr", image);
    texture_.filename = (folder_ / "a.exr").string();
  }
  std::vector<float> values(const ImageChange& change, int* width = nullptr) {
    const Image image = read_stored_image(images_.write(texture_, ImageUse::color, change)).image;
    if (width) *width = image.width;
    return image.values;
  }

  TemporaryFolder folder_;
  int count_ = 0;
  ConvertedImages images_{[this] { return folder_ / ("new" + std::to_string(count_++) + ".exr"); }};
  ImageTexture texture_;
};

TEST_F(ImagesBeside, EqualOnesAreWrittenOnce) {
  const auto first = images_.write(texture_, ImageUse::color);
  ImageTexture placed = texture_;
  placed.mapping = UvMapping{2};
  placed.wrap = Wrap::clamp;
  EXPECT_EQ(images_.write(placed, ImageUse::color), first) << "where it lies is not in the file";
  placed.scale = 2;
  EXPECT_NE(images_.write(placed, ImageUse::color), first);
  EXPECT_NE(images_.write(texture_, ImageUse::color, {{1, 1, 1}, {}, true}), first);
  EXPECT_EQ(count_, 3);
}

TEST_F(ImagesBeside, TintsAndChannels) {
  EXPECT_THAT(values({{2, 2, 2}, {}, false}), ElementsAre(2, 4, 6, 8));
  EXPECT_THAT(values({{1, 0.5, 2}, {}, false}), ElementsAre(1, .5f, 2, 2, 1, 4, 3, 1.5f, 6, 4, 2, 8));
  EXPECT_THAT(values({{1, 1, 1}, {}, true}), ElementsAre(1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4));
}

TEST_F(ImagesBeside, Mappings) {
  EXPECT_THAT(values({{1, 1, 1}, UvMapping{1, 0, 0, 0, -1, 1}, false}), ElementsAre(3, 4, 1, 2))
      << "upside down";
  EXPECT_THAT(values({{1, 1, 1}, UvMapping{-1, 0, 1, 0, 1, 0}, false}), ElementsAre(2, 1, 4, 3))
      << "mirrored";
  EXPECT_THAT(values({{1, 1, 1}, UvMapping{0, 1, 0, 1, 0, 0}, false}), ElementsAre(4, 2, 3, 1))
      << "s and t swapped";
  texture_.filter = TextureFilter::nearest;
  int width = 0;
  EXPECT_THAT(values({{1, 1, 1}, UvMapping{2, 0, 0, 0, 1, 0}, false}, &width),
              ElementsAre(1, 2, 1, 2, 3, 4, 3, 4));
  EXPECT_EQ(width, 4) << "twice over";
  texture_.wrap = Wrap::black;
  EXPECT_THAT(values({{1, 1, 1}, UvMapping{1, 0, .5f, 0, 1, 0}, false}), ElementsAre(2, 0, 4, 0)) << "moved";
  texture_.wrap = Wrap::mirror;
  EXPECT_THAT(values({{1, 1, 1}, UvMapping{1, 0, .5f, 0, 1, 0}, false}), ElementsAre(2, 2, 4, 4));
}

TEST_F(ImagesBeside, ProductsOfColorsAndAnImage) {
  Scene scene;
  const auto add = [&](TextureModel model) {
    scene.textures.push_back({std::move(model), false, "", {}});
    return Id<Texture>{static_cast<std::uint32_t>(scene.textures.size() - 1)};
  };
  const Id<Texture> image = add(texture_);
  const Id<Texture> inner = add(ProductTexture{Spectrum{unbounded_from_rgb({.5, 1, 2})}, image});
  const Id<Texture> outer = add(ProductTexture{inner, Spectrum{ConstantSpectrum{.5f}}});
  const auto found = tinted_image(scene, outer);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->image, texture_);
  EXPECT_NEAR(found->tint.r, .25, 1e-6);
  EXPECT_NEAR(found->tint.g, .5, 1e-6);
  EXPECT_NEAR(found->tint.b, 1, 1e-6);
  EXPECT_FALSE(tinted_image(scene, add(ProductTexture{image, image}))) << "two images are no image";
  EXPECT_FALSE(tinted_image(scene, add(DotsTexture{})));
}

}  // namespace
}  // namespace vitrail::converted_images_test
