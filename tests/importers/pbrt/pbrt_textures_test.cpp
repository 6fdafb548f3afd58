// SPDX-License-Identifier: Apache-2.0
// Textures of pbrt in the Scene's terms.
#include "scene/models/texture_mapping.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/pbrt/pbrt_text.h"
#include "tests/support/png.h"

namespace vitrail::pbrt_textures_test {
namespace {

// The texture "t" after `directives`, as a material uses it.
SpectrumParameter used(const ImportedScene& imported) {
  const Material& material = imported.scene.materials.at(imported.scene.shapes.at(0).material.value);
  return std::get<DiffuseMaterial>(material.model).reflectance;
}
const std::string user = " Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle;

template <class Model>
Model model(const std::string& directives) {
  const ImportedScene imported = import_v4(directives + user);
  return std::get<Model>(imported.scene.textures.at(std::get<Id<Texture>>(used(imported)).value).model);
}

TEST(PbrtTextures, ConstantsAreTheirValue) {
  const ImportedScene imported =
      import_v4("Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [.3 .2 .1]" + user);
  expect_no_diagnostics(imported);
  EXPECT_EQ(used(imported), SpectrumParameter{reflectance_from_rgb({.3, .2, .1})});
  EXPECT_TRUE(imported.scene.textures.empty());
}

TEST(PbrtTextures, ImagesKeepHowTheyAreRead) {
  const auto image = model<ImageTexture>(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"x.png\" \"float uscale\" 2 \"float "
      "vdelta\" .25 "
      "\"string wrap\" \"clamp\" \"string filter\" \"point\" \"string encoding\" \"gamma 2.2\" \"float "
      "scale\" .5 \"bool "
      "invert\" true");
  EXPECT_EQ(std::filesystem::path(image.filename).filename(), "x.png");
  EXPECT_TRUE(std::filesystem::path(image.filename).is_absolute());
  EXPECT_EQ(image.mapping, (TextureMapping{UvMapping{2, 0, 0, 0, 1, .25f}}));
  EXPECT_EQ(image.wrap, Wrap::clamp);
  EXPECT_EQ(image.filter, TextureFilter::nearest);
  EXPECT_EQ(image.encoding, Encoding::gamma);
  EXPECT_EQ(image.gamma, 2.2f);
  EXPECT_EQ(image.scale, .5f);
  EXPECT_TRUE(image.invert);
  EXPECT_EQ(image.primaries, Primaries::named);
}

// What v3 says of Ptex by one number: 2.2 unless it is given.
TEST(PbrtTextures, PtexOfV3HasAGamma) {
  const auto ptex = [](const std::string& parameters) {
    const ImportedScene imported =
        import_v3("Texture \"t\" \"spectrum\" \"ptex\" \"string filename\" \"a.ptx\" " + parameters +
                  " Material \"matte\" \"texture Kd\" \"t\" " + triangle);
    const auto t = std::get<PtexTexture>(imported.scene.textures.at(0).model);
    return std::pair(t.encoding, t.gamma);
  };
  EXPECT_EQ(ptex("").first, Encoding::automatic);
  EXPECT_EQ(ptex("\"float gamma\" 1").first, Encoding::linear);
  EXPECT_EQ(ptex("\"float gamma\" 1.8"), std::pair(Encoding::gamma, 1.8f));
}

// pbrt-v4 decodes other files than PNG as it wants; v3's `gamma` holds for all.
TEST(PbrtTextures, OnlyPngFilesTakeAnEncoding) {
  const auto encoding = [](const std::string& file, const std::string& how) {
    return model<ImageTexture>("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"" + file +
                               "\" \"string encoding\" \"" + how + "\"")
        .encoding;
  };
  EXPECT_EQ(encoding("a.PNG", "linear"), Encoding::linear);
  EXPECT_EQ(encoding("a.jpg", "linear"), Encoding::automatic);
  EXPECT_EQ(encoding("a.exr", "sRGB"), Encoding::automatic);
  EXPECT_EQ(encoding("a.tga", "gamma 1.8"), Encoding::automatic);
}

// pbrt-v4: the first channel alone where it takes single texels, else alpha (of RGBA files) or the mean; v3:
// the luminance of what is stored.
TEST(PbrtTextures, WhichNumberAnImageIs) {
  const TemporaryFolder folder;
  test::write_png(folder / "rgb.png", 1, 1, 3, {1, 2, 3});
  test::write_png(folder / "rgba.png", 1, 1, 4, {1, 2, 3, 4});
  test::write_png(folder / "ya.png", 1, 1, 2, {1, 2});
  const auto image = [&](const std::string& film, const std::string& file, const std::string& more) {
    const Scene scene =
        read_pbrt(folder.write("in.pbrt", film +
                                              " WorldBegin Texture \"t\" \"float\" "
                                              "\"imagemap\" \"string filename\" \"" +
                                              file + "\" " + more +
                                              " Material \"matte\" \"texture sigma\" \"t\" " + triangle))
            .scene;
    return std::get<ImageTexture>(scene.textures.at(0).model);
  };
  const std::string v4 = "Film \"rgb\"", v3 = "Film \"image\"";
  EXPECT_EQ(image(v4, "rgb.png", "").number, ImageNumber::mean);
  EXPECT_EQ(image(v4, "rgba.png", "").number, ImageNumber::alpha_or_mean);
  EXPECT_EQ(image(v4, "rgba.png", "\"string filter\" \"trilinear\"").number, ImageNumber::alpha_or_mean);
  EXPECT_EQ(image(v4, "x.exr", "").number, ImageNumber::alpha_or_mean);
  EXPECT_EQ(image(v4, "ya.png", "").number, ImageNumber::mean) << "pbrt drops the alpha of grey files";
  EXPECT_EQ(image(v4, "rgba.png", "\"string filter\" \"point\"").number, ImageNumber::red);
  EXPECT_EQ(image(v4, "rgba.png", "\"string filter\" \"ewa\"").number, ImageNumber::red);
  EXPECT_EQ(image(v3, "rgba.png", "").number, ImageNumber::stored_luminance);
  EXPECT_EQ(image(v4, "x.exr", "").primaries, Primaries::srgb) << "of the channels, not of a colour";
  EXPECT_EQ(image(v3, "x.exr", "").primaries, Primaries::srgb);
}

TEST(PbrtTextures, AColorThatStandsForANumberCountsByItsLuminance) {
  const ImportedScene imported = import_v3(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"x.png\" Material \"uber\" "
      "\"texture opacity\" \"t\" " +
      triangle);
  EXPECT_TRUE(mentions(imported.diagnostics, "luminance"));
  EXPECT_TRUE(imported.scene.textures.back().is_float);
  EXPECT_EQ(std::get<ImageTexture>(imported.scene.textures.back().model).number, ImageNumber::luminance);
}

TEST(PbrtTextures, OthersKeepTheirInputs) {
  const Spectrum red = reflectance_from_rgb({1, 0, 0});
  const auto board = model<CheckerboardTexture>(
      "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 0 0] \"float uscale\" 4");
  EXPECT_EQ(board.even, SpectrumParameter{red});
  EXPECT_EQ(board.odd, SpectrumParameter{ConstantSpectrum{0}});
  const auto mix = model<MixTexture>(
      "Texture \"a\" \"float\" \"wrinkled\" \"integer octaves\" 3 Texture \"t\" \"spectrum\" \"mix\" \"rgb "
      "tex2\" [1 0 0] "
      "\"texture amount\" \"a\"");
  EXPECT_EQ(mix.amount, FloatParameter{Id<Texture>{0}});
  EXPECT_EQ(mix.second, SpectrumParameter{red});
  const auto scaled = model<ProductTexture>(
      "Texture \"i\" \"spectrum\" \"imagemap\" \"string filename\" \"x.png\" "
      "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"i\" \"float scale\" .5");
  EXPECT_EQ(scaled.first, SpectrumParameter{Id<Texture>{0}});
  EXPECT_EQ(scaled.second, SpectrumParameter{ConstantSpectrum{.5f}});
  EXPECT_EQ(model<NoiseTexture>("Texture \"t\" \"spectrum\" \"marble\" \"float variation\" .5").variation,
            .5f);
  const auto dots = model<DotsTexture>("Texture \"t\" \"spectrum\" \"dots\" \"rgb inside\" [1 0 0]");
  EXPECT_EQ(dots.outside, SpectrumParameter{red});  // as pbrt shows it
}

TEST(PbrtTextures, TextureSpaceFollowsTheTransform) {
  const auto board = model<CheckerboardTexture>(
      "Scale 2 2 2 Texture \"t\" \"spectrum\" \"checkerboard\" \"integer dimension\" 3 Identity");
  EXPECT_TRUE(board.solid);
  EXPECT_EQ(board.texture_to_world, scale({2, 2, 2}));
}

// v3 takes the transform for its inverse in three dimensions, and none for planes.
TEST(PbrtTextures, TextureSpaceOfV3IsTurnedAround) {
  const auto texture = [](const std::string& kind) {
    const Scene scene = import_v3("Scale 2 2 2 Translate 1 0 0 Texture \"t\" \"spectrum\" " + kind +
                                  " Identity Material \"matte\" \"texture Kd\" \"t\" " + triangle)
                            .scene;
    return scene.textures.at(0).model;
  };
  const Transform there = inverse(scale({2, 2, 2}) * translate({1, 0, 0}));
  EXPECT_EQ(std::get<NoiseTexture>(texture("\"marble\"")).texture_to_world, there);
  EXPECT_EQ(
      std::get<CheckerboardTexture>(texture("\"checkerboard\" \"integer dimension\" 3")).texture_to_world,
      there);
  const auto planar =
      std::get<CheckerboardTexture>(texture("\"checkerboard\" \"string mapping\" \"planar\""));
  EXPECT_EQ(std::get<PlanarMapping>(planar.mapping).texture_to_world, Transform{});
}

// Around a cylinder v3 goes by the height of the direction, v4 by that of the point.
TEST(PbrtTextures, CylindersOfV3GoByDirections) {
  const std::string board = "Texture \"t\" \"spectrum\" \"checkerboard\" \"string mapping\" \"cylindrical\"";
  const Scene v3 = import_v3(board + " Material \"matte\" \"texture Kd\" \"t\" " + triangle).scene;
  const auto height = [](const CheckerboardTexture& t) {
    return map_point({t.mapping, {}}, {}, {0, 3, 4}).t;
  };
  EXPECT_DOUBLE_EQ(height(std::get<CheckerboardTexture>(v3.textures.at(0).model)), 0.8);
  EXPECT_EQ(height(model<CheckerboardTexture>(board)), 4);
}

TEST(PbrtTextures, MayFollowTheMaterialsThatUseThem) {
  const ImportedScene imported =
      import_v4(user + "Texture \"t\" \"spectrum\" \"constant\" \"float value\" .125");
  EXPECT_EQ(used(imported), SpectrumParameter{ConstantSpectrum{.125f}});
}

TEST(PbrtTextures, OfNumbersAndOfSpectraHaveNamesOfTheirOwn) {
  const ImportedScene imported = import_v4(
      "Texture \"t\" \"float\" \"constant\" \"float value\" 0 Texture \"t\" \"spectrum\" \"constant\" "
      "\"float value\" .125 " +
      user + "Material \"dielectric\" \"texture roughness\" \"t\" " + triangle);
  expect_no_diagnostics(imported);
  EXPECT_EQ(used(imported), SpectrumParameter{ConstantSpectrum{.125f}});
}

TEST(PbrtTextures, UnknownNamesAndKindsAreErrorsWithASuggestion) {
  const auto message = [](const std::string& directives) {
    try {
      import_v4(directives);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(
      message(
          "Texture \"wood\" \"spectrum\" \"bilerp\" Material \"diffuse\" \"texture reflectance\" \"woot\" " +
          triangle)
          .find("did you mean \"wood\""),
      std::string::npos);
  EXPECT_NE(message("Texture \"t\" \"spectrum\" \"imagmap\"" + user).find("did you mean \"imagemap\""),
            std::string::npos);
}

TEST(PbrtTextures, FilteringIsNoLoss) {
  const TemporaryFolder folder;
  folder.write("a.png", "");
  expect_no_diagnostics(read_pbrt(folder.write(
      "scene.pbrt",
      "Film \"image\"\nWorldBegin\nTexture \"t\" \"color\" \"imagemap\" \"string filename\" \"a.png\" "
      "\"bool trilinear\" \"true\" \"float maxanisotropy\" 4\nWorldEnd\n")));
}

}  // namespace
}  // namespace vitrail::pbrt_textures_test
