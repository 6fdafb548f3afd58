// SPDX-License-Identifier: Apache-2.0
// What Mitsuba takes from an image is what the Scene says.
#include <gmock/gmock.h>

#include <fstream>

#include <cmath>
#include <numbers>

#include "images/texture_values.h"
#include "importers/mitsuba/read/mitsuba.h"
#include "importers/mitsuba/write/write_images.h"
#include "importers/mitsuba/write/write_mitsuba.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"
#include "tests/support/png.h"

namespace vitrail::write_mitsuba_images_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

auto says(const std::string& text) { return Contains(Field(&Diagnostic::message, HasSubstr(text))); }

class MitsubaImages : public testing::Test {
 protected:
  // Writes a square with the texture for its reflectance or (a number) its roughness, and reads it again.
  ImageTexture written(TextureModel model, bool is_number) {
    const Id<Texture> id{static_cast<std::uint32_t>(textures_.size())};
    Material material;
    if (is_number) {
      ConductorMaterial metal;
      metal.roughness.alpha_u = metal.roughness.alpha_v = id;
      material.model = metal;
    } else {
      material.model = DiffuseMaterial{id};
    }
    Scene scene = square_scene(material);
    scene.textures = textures_;
    scene.textures.push_back({std::move(model), is_number, "t", {}});
    diagnostics_ = write_mitsuba(scene, folder_ / "out.xml");
    const Scene again = read_mitsuba(folder_ / "out.xml").scene;
    return std::get<ImageTexture>(again.textures.at(0).model);
  }
  ImageTexture image(const char* name) const {
    ImageTexture texture;
    texture.filename = (folder_ / name).string();
    return texture;
  }
  static std::vector<float> values(const ImageTexture& image, ImageUse use) {
    return texture_values(image, read_stored_image(image.filename), use).values;
  }
  void expect_kept(const ImageTexture& image, bool is_number, bool own_file) {
    const ImageTexture again = written(image, is_number);
    const ImageUse use = is_number ? ImageUse::number : ImageUse::color;
    const std::vector<float> expected = values(image, use), found = values(again, use);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-6) << i;
    EXPECT_EQ(again.filename == image.filename, own_file);
    if (own_file)
      EXPECT_THAT(diagnostics_, Not(says("are written as")));
    else
      EXPECT_THAT(diagnostics_, says("are written as"));
  }

  TemporaryFolder folder_;
  std::vector<Texture> textures_;
  Diagnostics diagnostics_;
};

TEST_F(MitsubaImages, EveryNumber) {
  test::write_png(folder_ / "rgba.png", 2, 1, 4, {51, 102, 204, 153, 10, 20, 30, 255});
  test::write_png(folder_ / "grey.png", 2, 1, 1, {51, 30});
  for (int i = 0; i <= static_cast<int>(ImageNumber::stored_luminance); ++i)
    for (const Encoding encoding : {Encoding::automatic, Encoding::linear}) {
      SCOPED_TRACE(i);
      ImageTexture texture = image("rgba.png");
      texture.number = static_cast<ImageNumber>(i);
      texture.encoding = encoding;
      const bool is_luminance =
          texture.number == ImageNumber::luminance || texture.number == ImageNumber::stored_luminance;
      // Its spectral variants refuse to make a number of colours that they decode.
      expect_kept(texture, true, is_luminance && encoding == Encoding::linear);
      texture.filename = image("grey.png").filename;
      expect_kept(texture, true, texture.number != ImageNumber::alpha);
    }
}

// What Mitsuba's own scene says of a colour image as a number comes back as it is, and nothing is said; but
// where its spectral variants refuse the image, as its values.
TEST_F(MitsubaImages, ItsOwnSceneStays) {
  test::write_png(folder_ / "rgb.png", 2, 2, 3, {51, 102, 204, 10, 20, 30, 1, 2, 3, 4, 5, 6});
  for (const std::string raw : {"true", "false"}) {
    const auto in = folder_.write(
        "in.xml",
        "<scene version='3.0.0'><shape type='rectangle'><bsdf type='mask'><texture type='bitmap' "
        "name='opacity'><string name='filename' value='rgb.png'/><boolean name='raw' value='" +
            raw + "'/></texture><bsdf type='diffuse'/></bsdf></shape></scene>");
    const Scene scene = read_mitsuba(in).scene;
    const Diagnostics written = write_mitsuba(scene, folder_ / "out.xml");
    const TextureModel model = scene.textures.at(0).model,
                       again = read_mitsuba(folder_ / "out.xml").scene.textures.at(0).model;
    if (raw == "true") {
      EXPECT_THAT(written, Not(says("values")));
      EXPECT_EQ(again, model);
      EXPECT_FALSE(std::filesystem::exists(folder_ / "out-images"));
    } else {
      EXPECT_THAT(written, says("take no number from three channels"));
    }
  }
}

TEST_F(MitsubaImages, ATintedImageKeepsItsImage) {
  test::write_png(folder_ / "rgb.png", 2, 1, 3, {51, 102, 204, 10, 20, 30});
  const ImageTexture texture = image("rgb.png");
  textures_ = {{texture, false, "plain", {}}};
  const std::vector<float> plain = values(texture, ImageUse::color),
                           tinted = values(
                               written(ProductTexture{rgb_reflectance(.5, 1, .25), Id<Texture>{0}}, false),
                               ImageUse::color);
  ASSERT_EQ(tinted.size(), plain.size());
  constexpr std::array tint{.5f, 1.0f, .25f};
  for (std::size_t i = 0; i < tinted.size(); ++i) EXPECT_NEAR(tinted[i], plain[i] * tint[i % 3], 1e-6) << i;
}

// By Mitsuba 3.9.1's bitmaps.
TEST_F(MitsubaImages, KindsThatMitsubaReads) {
  for (const char* name : {"a.png", "a.PNG", "a.exr", "a.hdr", "a.bmp"})
    EXPECT_TRUE(mitsuba_writer::is_read_by_mitsuba(name)) << name;
  for (const char* name : {"a.gif", "a.tif", "a.webp", "a"})
    EXPECT_FALSE(mitsuba_writer::is_read_by_mitsuba(name)) << name;
  std::ofstream(folder_ / "plain.tga") << std::string{0, 0, 2};
  std::ofstream(folder_ / "palette.tga") << std::string{0, 1, 1};
  for (const char components : {'\1', '\3', '\4'}) {
    // A comment of two bytes, then the frame: 8 bits, 1 × 1.
    const std::string jpeg = "\xff\xd8\xff\xfe" + std::string{0, 4, 'h', 'i'} + "\xff\xc0" +
                             std::string{0, 8, 8, 0, 1, 0, 1, components};
    std::ofstream(folder_ / "a.jpg", std::ios::binary) << jpeg;
    EXPECT_EQ(mitsuba_writer::is_read_by_mitsuba((folder_ / "a.jpg").string()), components < 4);
  }
  EXPECT_TRUE(mitsuba_writer::is_read_by_mitsuba((folder_ / "plain.tga").string()));
  EXPECT_FALSE(mitsuba_writer::is_read_by_mitsuba((folder_ / "palette.tga").string()));
}

TEST_F(MitsubaImages, AProductOfTwoIsOne) {
  test::write_png(folder_ / "rgb.png", 2, 1, 3, {51, 102, 204, 10, 20, 30});
  test::write_png(folder_ / "grey.png", 4, 2, 1, {0, 255, 0, 255, 128, 128, 255, 0});
  const ImageTexture colors = image("rgb.png"), shade = image("grey.png");
  textures_ = {{colors, false, "colors", {}}, {shade, false, "shade", {}}};
  const ImageTexture product = written(ProductTexture{Id<Texture>{0}, Id<Texture>{1}}, false);
  EXPECT_THAT(diagnostics_, says("the product of two images"));
  const std::vector<float> a = values(colors, ImageUse::color), b = values(shade, ImageUse::color),
                           found = values(product, ImageUse::color);
  ASSERT_EQ(found.size(), std::size_t{4 * 2 * 3});
  for (std::size_t x = 0; x < 4; ++x)
    for (std::size_t c = 0; c < 3; ++c) {
      // Quarters of the way between the two texels, which repeat.
      const float left = x < 2 ? .75f : .25f;
      EXPECT_NEAR(found[3 * x + c], b[x] * (left * a[c] + (1 - left) * a[3 + c]), 1e-6) << x << " " << c;
      EXPECT_NEAR(found[12 + 3 * x + c], b[4 + x] * (left * a[c] + (1 - left) * a[3 + c]), 1e-6);
    }
}

// Red above and blue below: as in pbrt, times cos³θ, which the plane at distance 1 gets of it.
TEST_F(MitsubaImages, ProjectionsOfPbrtKeepTheirIntensity) {
  Image two = black_image(4, 2, 3);
  for (std::size_t i = 0; i < 12; ++i)
    two.values[i] = i % 3 == 0 ? 1.0f : 0.0f, two.values[12 + i] = i % 3 == 2 ? 1.0f : 0.0f;
  write_exr_image(folder_ / "two.exr", two);
  Scene scene = square_scene(Material{DiffuseMaterial{}});
  scene.textures.push_back({image("two.exr"), false, "", {}});
  ProjectionLight light;
  light.image = Id<Texture>{0};
  light.fov_deg = 90;
  light.scale = ConstantSpectrum{3};
  scene.lights = {{light, {}}};
  write_mitsuba(scene, folder_ / "out.xml");
  const Scene again = read_mitsuba(folder_ / "out.xml").scene;
  const auto& read = std::get<ProjectionLight>(again.lights.at(0).model);
  EXPECT_NEAR(std::tan(read.fov_deg / 360 * std::numbers::pi), 2, 1e-5) << "of the width";
  EXPECT_NEAR(evaluate(read.scale, 500), 3 / std::numbers::pi, 1e-6);
  const auto& texture =
      std::get<ImageTexture>(again.textures.at(std::get<Id<Texture>>(*read.image).value).model);
  EXPECT_EQ(texture.mapping, (TextureMapping{UvMapping{1, 0, 0, 0, -1, 1}}));
  const std::vector<float> found = values(texture, ImageUse::light);
  ASSERT_EQ(found.size(), 512u * 256 * 3) << "the cosine changes within a texel";
  for (std::size_t i = 0; i < two.values.size(); ++i) {
    const std::size_t row = i / 12 * 128 + 64, column = i / 3 % 4 * 128 + 64;
    const double x = (2 * static_cast<double>(column) + 1) / 256 - 2,
                 y = (2 * static_cast<double>(row) + 1) / 256 - 1;
    EXPECT_NEAR(found.at((row * 512 + column) * 3 + i % 3),
                static_cast<double>(two.values[i]) * std::pow(1 + x * x + y * y, -1.5), 0.01)
        << i;
  }
}

// Mitsuba has no black outside: it gets a border of black, whose edge goes on.
TEST_F(MitsubaImages, BlackOutsideIsABorder) {
  Image grey = black_image(2, 1, 1);
  grey.values = {0.25f, 0.5f};
  write_exr_image(folder_ / "grey.exr", grey);
  ImageTexture texture = image("grey.exr");
  texture.wrap = Wrap::black;
  texture.mapping = UvMapping{2, 0, 0, 0, 1, 0};
  const ImageTexture again = written(texture, true);
  EXPECT_EQ(again.wrap, Wrap::clamp);
  EXPECT_EQ(values(again, ImageUse::number), (std::vector<float>{0, 0, 0, 0, 0, 0.25f, 0.5f, 0, 0, 0, 0, 0}));
  const auto& m = std::get<UvMapping>(again.mapping);
  EXPECT_FLOAT_EQ(m.a, 1);  // of 2 texels of 4
  EXPECT_FLOAT_EQ(m.c, 0.25f);
  EXPECT_FLOAT_EQ(m.e, 1.0f / 3);
  EXPECT_FLOAT_EQ(m.f, 1.0f / 3);
  EXPECT_THAT(diagnostics_, Not(says("black outside")));
}

}  // namespace
}  // namespace vitrail::write_mitsuba_images_test
