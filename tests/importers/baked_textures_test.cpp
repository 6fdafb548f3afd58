// SPDX-License-Identifier: Apache-2.0
// Textures that a format has no kind for are images in what is written.
#include "importers/images/baked_textures.h"

#include <gmock/gmock.h>

#include "images/texture_values.h"
#include "importers/export.h"
#include "importers/import.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::baked_textures_test {
namespace {

using testing::HasSubstr;

SpectrumParameter grey(float value) { return Spectrum{ConstantSpectrum{value}}; }
CheckerboardTexture board(float cells_u, float cells_v, SpectrumParameter even = grey(0.25f),
                          SpectrumParameter odd = grey(0.75f)) {
  CheckerboardTexture t{even, odd, UvMapping{cells_u, 0, 0, 0, cells_v, 0}, false, {}};
  return t;
}

class Baked : public testing::Test {
 protected:
  Baked() { scene_ = square_scene(Material{DiffuseMaterial{Id<Texture>{0}}}); }

  const BakedTexture* bake(const TextureModel& model, const char* extension = "exr") {
    scene_.textures.push_back(Texture{model, false, "t", {}});
    textures_.emplace(
        scene_, [this, extension] { return folder_ / ("new" + std::to_string(count_++) + "." + extension); });
    return textures_->bake({static_cast<std::uint32_t>(scene_.textures.size() - 1)});
  }
  // At (u,v) that the image is laid out by.
  static float at(const ImageTexture& texture, double u, double v) {
    const Image image = texture_values(texture, read_stored_image(texture.filename), ImageUse::color);
    const auto& m = std::get<UvMapping>(texture.mapping);
    const double s = static_cast<double>(m.a) * u + static_cast<double>(m.c),
                 t = static_cast<double>(m.e) * v + static_cast<double>(m.f);
    const auto texel = [](double x, int n) { return static_cast<int>((x - std::floor(x)) * n); };
    return image.values[static_cast<std::size_t>(
        ((image.height - 1 - texel(t, image.height)) * image.width + texel(s, image.width)) *
        image.channels)];
  }
  // Four by two texels of 0, .125, … from the lower left one on.
  Id<Texture> image(Wrap wrap = Wrap::repeat) {
    Image values = black_image(4, 2, 1);
    values.values = {0.5f, 0.625f, 0.75f, 0.875f, 0, 0.125f, 0.25f, 0.375f};
    write_exr_image(folder_ / "i.exr", values);
    ImageTexture t;
    t.filename = (folder_ / "i.exr").string(), t.wrap = wrap;
    scene_.textures.push_back(Texture{t, false, "i", {}});
    return {static_cast<std::uint32_t>(scene_.textures.size() - 1)};
  }

  TemporaryFolder folder_;
  Scene scene_;
  int count_ = 0;
  std::optional<BakedTextures> textures_;
};

TEST_F(Baked, CellsBeginWithATexelAndRepeat) {
  const BakedTexture* baked = bake(board(6, 10));
  ASSERT_TRUE(baked);
  const Image image = read_stored_image(baked->image.filename).image;
  EXPECT_EQ(image.width % 6, 0);
  EXPECT_EQ(image.height % 10, 0);
  EXPECT_GE(std::min(image.width, image.height), 512);
  EXPECT_EQ(baked->image.filter, TextureFilter::nearest);
  EXPECT_EQ(baked->image.wrap, Wrap::repeat);
  EXPECT_THAT(baked->note, HasSubstr("texture \"t\" (checkerboard): an image of"));
  for (const double u : {-0.42, 0.01, 0.16, 0.17, 0.49, 0.51, 0.99, 1.3})
    for (const double v : {-0.31, 0.04, 0.101, 0.95, 2.22})
      EXPECT_EQ(at(baked->image, u, v),
                (static_cast<int>(std::floor(6 * u) + std::floor(10 * v)) & 1) ? 0.75f : 0.25f)
          << u << " " << v;
  EXPECT_EQ(textures_->bake({0}), baked) << "once";
}

TEST_F(Baked, OddNumbersOfCellsRepeatAfterTwo) {
  const BakedTexture* baked = bake(board(5, 4));
  ASSERT_TRUE(baked);
  EXPECT_EQ(std::get<UvMapping>(baked->image.mapping), (UvMapping{0.5f, 0, 0, 0, 1, 0}));
  EXPECT_EQ(at(baked->image, 0.1, 0.1), 0.25f);
  EXPECT_EQ(at(baked->image, 1.1, 0.1), 0.75f);
}

TEST_F(Baked, WhatDoesNotRepeatSaysSo) {
  const BakedTexture* baked = bake(board(7.3f, 4));
  ASSERT_TRUE(baked);
  EXPECT_EQ(baked->image.wrap, Wrap::clamp);
  EXPECT_THAT(baked->note, HasSubstr("for (u,v) from 0 to 1"));
  EXPECT_EQ(bake(BilinearTexture{grey(0), grey(1), grey(0.5f), grey(1), {}})->image.wrap, Wrap::clamp);
  EXPECT_NEAR(at(textures_->bake({1})->image, 0.5, 0.25), (0.25 * 0.75 + 1 * 0.25), 0.002);
}

TEST_F(Baked, ImagesKeepTheirTexels) {
  const Id<Texture> i = image();
  const BakedTexture* baked = bake(MixTexture{i, grey(1), 0.25f});
  ASSERT_TRUE(baked);
  const Image values = read_stored_image(baked->image.filename).image;
  EXPECT_EQ(values.width, 4);
  EXPECT_EQ(values.height, 2);
  for (std::size_t k = 0; k < 8; ++k) {
    const float step = 0.125f * static_cast<float>(k % 4);
    EXPECT_FLOAT_EQ(values.values[3 * k], 0.75f * (k < 4 ? 0.5f + step : step) + 0.25f) << k;
  }
  EXPECT_EQ(baked->image.filter, TextureFilter::bilinear);
  const BakedTexture* product = bake(ProductTexture{Id<Texture>{1}, i});
  ASSERT_TRUE(product);
  EXPECT_FLOAT_EQ(read_stored_image(product->image.filename).image.values[0], (0.75f * 0.5f + 0.25f) * 0.5f);
}

TEST_F(Baked, OfEightBitsAreScaledToOne) {
  const BakedTexture* baked = bake(board(2, 2, grey(0.5f), grey(4)), "png");
  ASSERT_TRUE(baked);
  EXPECT_FLOAT_EQ(baked->image.scale, 4);
  EXPECT_NEAR(at(baked->image, 0.1, 0.1), 0.5, 0.01);
  EXPECT_NEAR(at(baked->image, 0.1, 0.6), 4, 1e-6);
}

TEST_F(Baked, NotWhatGoesByMoreThanTheSurface) {
  CheckerboardTexture solid = board(2, 2), around = board(2, 2);
  solid.solid = true;
  around.mapping = SphericalMapping{};
  ImageTexture missing;
  missing.filename = (folder_ / "none.png").string();
  EXPECT_FALSE(bake(solid));
  EXPECT_FALSE(bake(around));
  EXPECT_FALSE(bake(NoiseTexture{}));
  EXPECT_FALSE(bake(missing));
  EXPECT_FALSE(bake(MixTexture{Id<Texture>{0}, grey(1), 0.5f})) << "of one that does";
  EXPECT_EQ(count_, 0);
}

// In each format that has no such texture the file is read back with an image of it.
TEST_F(Baked, EachFormatHasThem) {
  for (const char* extension : {"obj", "gltf", "glb", "xml"}) {
    Scene scene = square_scene(Material{DiffuseMaterial{Id<Texture>{2}}});
    scene.textures = {Texture{board(4, 4), false, "b", {}}, Texture{board(2, 2), false, "c", {}},
                      Texture{MixTexture{Id<Texture>{0}, Id<Texture>{1}, 0.5f}, false, "t", {}}};
    const std::filesystem::path file = folder_ / (std::string("s.") + extension);
    export_scene(scene, file);
    const Scene again = import_scene(file).scene;

    const ImageTexture* image = nullptr;
    for (const Texture& t : again.textures)
      if (const auto* found = std::get_if<ImageTexture>(&t.model)) image = found;
    ASSERT_TRUE(image) << extension;
    EXPECT_NEAR(at(*image, 0.1, 0.1), 0.25, 0.005) << extension;
    EXPECT_NEAR(at(*image, 0.3, 0.1), 0.5, 0.005) << extension;
    EXPECT_NEAR(at(*image, 0.6, 0.1), 0.5, 0.005) << extension;
    EXPECT_NEAR(at(*image, 0.8, 0.1), 0.75, 0.005) << extension;
  }
}

}  // namespace
}  // namespace vitrail::baked_textures_test
