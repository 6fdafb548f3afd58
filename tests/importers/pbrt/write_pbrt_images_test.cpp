// SPDX-License-Identifier: Apache-2.0
// What pbrt takes from an image is what the Scene says.
#include <cmath>
#include <fstream>
#include <numbers>

#include "importers/pbrt/write/write_pbrt.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/pbrt/pbrt_text.h"
#include "tests/importers/written_scenes.h"
#include "tests/support/png.h"

#include "images/texture_values.h"

namespace vitrail::write_pbrt_images_test {
namespace {

class PbrtImages : public testing::Test {
 protected:
  // Writes a square whose reflectance (or sigma, a number) is the texture, and reads it again.
  Texture written(TextureModel model, bool is_number) {
    DiffuseMaterial diffuse;
    if (is_number)
      diffuse.sigma_deg = Id<Texture>{static_cast<std::uint32_t>(textures_.size())};
    else
      diffuse.reflectance = Id<Texture>{static_cast<std::uint32_t>(textures_.size())};
    Scene scene = square_scene(Material{diffuse});
    scene.textures = textures_;
    scene.textures.push_back({std::move(model), is_number, "t", {}});
    diagnostics_ = write_pbrt(scene, folder_ / "out.pbrt");
    const Scene again = read_pbrt(folder_ / "out.pbrt").scene;
    return again.textures.at(textures_.size());
  }
  ImageTexture image(const char* name) const {
    ImageTexture texture;
    texture.filename = (folder_ / name).string();
    texture.primaries = Primaries::named;
    return texture;
  }
  static std::vector<float> values(const Texture& texture, ImageUse use) {
    const auto& image = std::get<ImageTexture>(texture.model);
    return texture_values(image, read_stored_image(image.filename), use).values;
  }
  static std::vector<float> values(const ImageTexture& image, ImageUse use) {
    return texture_values(image, read_stored_image(image.filename), use).values;
  }
  // What is read again has the same values, and says so where its file is another.
  void expect_kept(const ImageTexture& image, bool is_number, bool own_file) {
    const Texture again = written(image, is_number);
    const ImageUse use = is_number ? ImageUse::number : ImageUse::color;
    const std::vector<float> expected = values(image, use), found = values(again, use);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-6) << i;
    EXPECT_EQ(std::get<ImageTexture>(again.model).filename == image.filename, own_file);
    EXPECT_EQ(mentions(diagnostics_, "takes other values from its image"), !own_file);
  }

  TemporaryFolder folder_;
  std::vector<Texture> textures_;
  Diagnostics diagnostics_;
};

TEST_F(PbrtImages, EveryNumber) {
  test::write_png(folder_ / "rgba.png", 2, 1, 4, {51, 102, 204, 153, 10, 20, 30, 255});
  test::write_png(folder_ / "rgb.png", 2, 1, 3, {51, 102, 204, 10, 20, 30});
  test::write_png(folder_ / "grey.png", 2, 1, 3, {51, 51, 51, 30, 30, 30});
  for (int i = 0; i <= static_cast<int>(ImageNumber::stored_luminance); ++i) {
    SCOPED_TRACE(i);
    ImageTexture texture = image("rgba.png");
    texture.number = static_cast<ImageNumber>(i);
    const bool by_alpha = texture.number == ImageNumber::alpha ||
                          texture.number == ImageNumber::alpha_or_mean ||
                          texture.number == ImageNumber::alpha_or_luminance;
    expect_kept(texture, true, by_alpha);
    texture.filter = TextureFilter::nearest;
    expect_kept(texture, true, texture.number == ImageNumber::red);
    texture.filter = TextureFilter::bilinear;
    texture.filename = image("rgb.png").filename;
    expect_kept(texture, true,
                texture.number == ImageNumber::mean || texture.number == ImageNumber::alpha_or_mean);
    texture.filename = image("grey.png").filename;
    expect_kept(texture, true, texture.number != ImageNumber::alpha);
  }
}

TEST_F(PbrtImages, EncodingsScaleAndInversion) {
  test::write_png(folder_ / "rgb.png", 2, 1, 3, {51, 102, 204, 10, 20, 30});
  ImageTexture texture = image("rgb.png");
  texture.encoding = Encoding::linear, texture.scale = 0.5f, texture.invert = true;
  expect_kept(texture, false, true);
}

// pbrt repeats and does not mirror.
TEST_F(PbrtImages, AMirroredImageBecomesFour) {
  test::write_png(folder_ / "rgb.png", 2, 1, 3, {51, 102, 204, 10, 20, 30});
  ImageTexture texture = image("rgb.png");
  texture.wrap = Wrap::mirror, texture.mapping = UvMapping{3, 0, 0.5f, 0, 1, 0.25f};
  const Texture again = written(texture, false);
  const auto& found = std::get<ImageTexture>(again.model);
  EXPECT_EQ(found.wrap, Wrap::repeat);
  EXPECT_EQ(std::get<UvMapping>(found.mapping), (UvMapping{1.5f, 0, 0.25f, 0, 0.5f, 0.125f}));
  const std::vector<float> one = values(texture, ImageUse::color), four = values(again, ImageUse::color);
  ASSERT_EQ(four.size(), 4 * one.size());
  for (std::size_t y = 0; y < 2; ++y)
    for (std::size_t x = 0; x < 4; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(four[(y * 4 + x) * 3 + c], one[(x == 0 || x == 3 ? 0u : 1u) * 3 + c], 1e-6) << x << y;
}

TEST_F(PbrtImages, ATintedImageKeepsItsImage) {
  test::write_png(folder_ / "rgb.png", 2, 1, 3, {51, 102, 204, 10, 20, 30});
  const ImageTexture texture = image("rgb.png");
  textures_ = {{texture, false, "plain", {}}};
  const Texture again =
      written(ProductTexture{Spectrum{unbounded_from_rgb({.5, 1, .25})}, Id<Texture>{0}}, false);
  const std::vector<float> plain = values(texture, ImageUse::color), tinted = values(again, ImageUse::color);
  ASSERT_EQ(tinted.size(), plain.size());
  constexpr std::array tint{.5f, 1.0f, .25f};
  for (std::size_t i = 0; i < tinted.size(); ++i) EXPECT_NEAR(tinted[i], plain[i] * tint[i % 3], 1e-6) << i;
}

TEST_F(PbrtImages, ANumberBeforeATextureScalesIt) {
  test::write_png(folder_ / "rgb.png", 1, 1, 3, {51, 102, 204});
  textures_ = {{image("rgb.png"), false, "plain", {}}};
  const Texture again = written(ProductTexture{Spectrum{ConstantSpectrum{.5f}}, Id<Texture>{0}}, false);
  EXPECT_EQ(std::get<ProductTexture>(again.model),
            (ProductTexture{Id<Texture>{0}, Spectrum{ConstantSpectrum{.5f}}}));
  EXPECT_TRUE(diagnostics_.empty());
}

// pbrt's images of light stand on the uv; it wants three channels.
TEST_F(PbrtImages, LightsAndNormalMapsAreTurnedAsTheyLie) {
  Image grey = black_image(1, 2, 1);
  grey.values = {1, 3};
  write_exr_image(folder_ / "grey.exr", grey);
  ImageTexture texture = image("grey.exr");
  texture.mapping = UvMapping{1, 0, 0, 0, -1, 1};
  Scene scene = square_scene(Material{DiffuseMaterial{}});
  scene.textures.push_back({texture, false, "", {}});
  AreaLight light;
  light.radiance = Id<Texture>{0};
  scene.area_lights.push_back(light);
  scene.shapes[0].area_light = Id<AreaLight>{0};
  scene.materials[0].normal_map = Id<Texture>{0};
  write_pbrt(scene, folder_ / "out.pbrt");
  const Scene again = read_pbrt(folder_ / "out.pbrt").scene;
  const std::vector<float> expected{3, 3, 3, 1, 1, 1};
  const Id<Texture> shining = std::get<Id<Texture>>(again.area_lights.at(0).radiance);
  EXPECT_EQ(values(again.textures.at(shining.value), ImageUse::light), expected);
  const Id<Texture> normal = again.materials.at(again.shapes.at(0).material.value).normal_map.value();
  EXPECT_EQ(values(again.textures.at(normal.value), ImageUse::vector), expected);
}

// The image is red above and blue below. Mitsuba's numbers are irradiance on a plane ÷ π.
TEST_F(PbrtImages, ProjectorsOfMitsubaKeepTheirIntensity) {
  Image two = black_image(4, 2, 3);
  for (std::size_t i = 0; i < 12; ++i)
    two.values[i] = i % 3 == 0 ? 1.0f : 0.0f, two.values[12 + i] = i % 3 == 2 ? 1.0f : 0.0f;
  write_exr_image(folder_ / "two.exr", two);
  ImageTexture texture = image("two.exr");
  texture.mapping = UvMapping{1, 0, 0, 0, -1, 1};  // Mitsuba's v runs down
  Scene scene = square_scene(Material{DiffuseMaterial{}});
  scene.textures.push_back({texture, false, "", {}});
  ProjectionLight light;
  light.image = Id<Texture>{0};
  light.irradiance = true;
  light.fov_deg = 90;
  light.scale = ConstantSpectrum{3};
  scene.lights = {{light, {}}};
  write_pbrt(scene, folder_ / "out.pbrt");
  const Scene again = read_pbrt(folder_ / "out.pbrt").scene;
  const auto& read = std::get<ProjectionLight>(again.lights.at(0).model);
  EXPECT_NEAR(std::tan(read.fov_deg / 360 * std::numbers::pi), 0.5, 1e-6) << "of the shorter side";
  EXPECT_NEAR(evaluate(read.scale, 500), 3 * std::numbers::pi, 1e-5);
  const std::vector<float> found =
      values(again.textures.at(std::get<Id<Texture>>(*read.image).value), ImageUse::light);
  ASSERT_EQ(found.size(), 512u * 256 * 3) << "the cosine changes within a texel";
  for (std::size_t i = 0; i < two.values.size(); ++i) {
    const std::size_t row = i / 12 * 128 + 64, column = i / 3 % 4 * 128 + 64;
    const double x = (2 * static_cast<double>(column) + 1) / 512 - 1,
                 y = (2 * static_cast<double>(row) + 1) / 512 - 0.5;
    EXPECT_NEAR(found.at((row * 512 + column) * 3 + i % 3),
                static_cast<double>(two.values[i]) * std::pow(1 + x * x + y * y, 1.5), 0.02)
        << i;
  }
}

TEST_F(PbrtImages, UniformIrradianceIsAnImageOfIntensity) {
  Scene scene = square_scene(Material{DiffuseMaterial{}});
  ProjectionLight light;
  light.image = Spectrum{emission_from_rgb({1, 2, 3})};
  light.irradiance = true;
  light.fov_deg = 60;
  light.scale = ConstantSpectrum{2};
  scene.lights = {{light, {}}};
  write_pbrt(scene, folder_ / "out.pbrt");
  const Scene again = read_pbrt(folder_ / "out.pbrt").scene;
  const auto& read = std::get<ProjectionLight>(again.lights.at(0).model);
  EXPECT_NEAR(read.fov_deg, 60, 1e-4);
  const std::vector<float> found =
      values(again.textures.at(std::get<Id<Texture>>(*read.image).value), ImageUse::light);
  const double corner = std::tan(std::numbers::pi / 6) * (1 - 1.0 / 64);
  const double scale = evaluate(read.scale, 500) / std::numbers::pi;
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(scale * static_cast<double>(found[c]),
                2 * static_cast<double>(c + 1) * std::pow(1 + 2 * corner * corner, 1.5), 1e-4);
}

// What multiplies the image of a light is in it, where it is a colour.
TEST_F(PbrtImages, ColoursOfEnvironmentsAreInTheirImages) {
  Image sky = black_image(4, 2, 3);
  std::ranges::fill(sky.values, 1.0f);
  write_exr_image(folder_ / "sky.exr", sky);
  EnvironmentLight light;
  light.filename = (folder_ / "sky.exr").string();
  light.projection = EnvironmentLight::Projection::latitude_longitude;
  light.scale = unbounded_from_rgb({2, 1, 0.5});
  Scene scene = square_scene(Material{DiffuseMaterial{}});
  scene.lights = {{light, {}}};
  write_pbrt(scene, folder_ / "out.pbrt");
  const auto read = std::get<EnvironmentLight>(read_pbrt(folder_ / "out.pbrt").scene.lights.at(0).model);
  EXPECT_EQ(read.scale, Spectrum{ConstantSpectrum{1}});
  const Image written = read_stored_image(read.filename).image;
  EXPECT_NEAR(written.values[0], 2, 1e-5);
  EXPECT_NEAR(written.values[1], 1, 1e-5);
  EXPECT_NEAR(written.values[2], 0.5, 1e-5);
}

// Another scene beside it has images of that name.
TEST_F(PbrtImages, NoImageOfAnotherIsReplaced) {
  Scene scene = square_scene(Material{DiffuseMaterial{}});
  std::filesystem::create_directory(folder_ / "out-images");
  folder_.write("out-images/000000.exr", "somebody's");
  Image sky = black_image(4, 2, 3);
  write_exr_image(folder_ / "sky.exr", sky);
  EnvironmentLight light;
  light.filename = (folder_ / "sky.exr").string();
  light.projection = EnvironmentLight::Projection::latitude_longitude;
  scene.lights = {{light, {}}};
  for (int again = 0; again < 2; ++again) {
    write_pbrt(scene, folder_ / "out.pbrt");
    const auto read = std::get<EnvironmentLight>(read_pbrt(folder_ / "out.pbrt").scene.lights.at(0).model);
    EXPECT_EQ(std::filesystem::path(read.filename).filename(), "000000-2.exr");
  }
  EXPECT_EQ(std::filesystem::file_size(folder_ / "out-images/000000.exr"), 10u);
}

// pbrt's spot lights have no texture: they become projections, dark from the cutoff on.
TEST_F(PbrtImages, SpotLightsWithTexturesBecomeProjections) {
  Image two = black_image(4, 2, 3);
  for (std::size_t i = 0; i < two.values.size(); ++i) two.values[i] = i < 12 ? 2.0f : 4.0f;
  write_exr_image(folder_ / "two.exr", two);
  Scene scene = square_scene(Material{DiffuseMaterial{}});
  ImageTexture texture = image("two.exr");
  texture.filter = TextureFilter::nearest;
  scene.textures.push_back({texture, false, "", {}});
  SpotLight light;
  light.intensity = emission_from_rgb({3, 3, 3});
  light.beam_deg = 20, light.cutoff_deg = 40;
  light.falloff = SpotLight::Falloff::linear;
  light.texture = Id<Texture>{0};
  scene.lights = {{light, {}}};
  write_pbrt(scene, folder_ / "out.pbrt");
  const Scene again = read_pbrt(folder_ / "out.pbrt").scene;
  const auto& read = std::get<ProjectionLight>(again.lights.at(0).model);
  EXPECT_FLOAT_EQ(read.fov_deg, 80);
  EXPECT_NEAR(evaluate(read.scale, 500), 1, 1e-6);
  const std::vector<float> found =
      values(again.textures.at(std::get<Id<Texture>>(*read.image).value), ImageUse::light);
  ASSERT_EQ(found.size(), 512u * 512 * 3);
  const auto at = [&](std::size_t x, std::size_t y) { return found[(y * 512 + x) * 3]; };
  constexpr double degree = std::numbers::pi / 180;
  const double theta = std::atan(std::tan(40 * degree) * (1 - 81 / 512.0));
  EXPECT_NEAR(at(256, 40), 6 * (2 - theta / (20 * degree)), .02);
  EXPECT_NEAR(at(256, 200), 6, 1e-4);
  EXPECT_NEAR(at(256, 300), 12, 1e-4);
  EXPECT_EQ(at(3, 3), 0);
}

}  // namespace
}  // namespace vitrail::write_pbrt_images_test
