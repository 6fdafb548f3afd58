// SPDX-License-Identifier: Apache-2.0
// What the channels of a file are, and what a texture makes of them.
#include "images/texture_values.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"
#include "tests/support/png.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::texture_values_test {
namespace {

using testing::ElementsAre;
using testing::FloatNear;

class TextureValues : public testing::Test {
 protected:
  std::filesystem::path png(int channels, const std::vector<std::uint8_t>& pixel, int bits = 8) {
    const std::filesystem::path file = folder_ / "a.png";
    test::write_png(file, 1, 1, channels, pixel, bits);
    return file;
  }
  // An EXR file of one pixel, with R, G, B and A or the first of them.
  std::filesystem::path exr(const std::vector<float>& pixel, const std::vector<float>& chromaticities = {}) {
    const std::filesystem::path file = folder_ / "a.exr";
    OIIO::ImageSpec spec(1, 1, static_cast<int>(pixel.size()), OIIO::TypeDesc::FLOAT);
    if (!chromaticities.empty())
      spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities.data());
    const auto out = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(out->open(file.string(), spec) && out->write_image(spec.format, pixel.data()) &&
                out->close());
    return file;
  }
  static std::vector<float> values(const std::filesystem::path& file, ImageUse use,
                                   ImageTexture texture = {}) {
    texture.filename = file.string();
    return texture_values(texture, read_stored_image(file), use).values;
  }
  static double number(const std::filesystem::path& file, ImageNumber number,
                       Encoding encoding = Encoding::linear) {
    ImageTexture texture;
    texture.number = number;
    texture.encoding = encoding;
    const std::vector<float> found = values(file, ImageUse::number, texture);
    EXPECT_EQ(found.size(), 1u);
    return static_cast<double>(found.at(0));
  }

  test::TemporaryDirectory folder_;
};

auto near(double value, double tolerance = 1e-6) {
  return FloatNear(static_cast<float>(value), static_cast<float>(tolerance));
}

TEST_F(TextureValues, AlphaIsNotMultipliedIntoColors) {
  const auto file = png(4, {200, 100, 50, 0});
  EXPECT_EQ(read_image_layout(file).channels, 4);
  EXPECT_THAT(read_stored_image(file).image.values,
              ElementsAre(near(200 / 255.0), near(100 / 255.0), near(50 / 255.0), near(0)));
  EXPECT_THAT(read_linear_image(file).values,
              ElementsAre(near(srgb_decode(200 / 255.0)), near(srgb_decode(100 / 255.0)),
                          near(srgb_decode(50 / 255.0))));
  EXPECT_THAT(read_stored_image(png(2, {200, 10})).image.values,
              ElementsAre(near(200 / 255.0), near(10 / 255.0)));
  EXPECT_THAT(
      read_stored_image(png(4, {200, 0, 100, 0, 50, 0, 16, 0}, 16)).image.values,
      ElementsAre(near(51200 / 65535.0), near(25600 / 65535.0), near(12800 / 65535.0), near(4096 / 65535.0)));
}

TEST_F(TextureValues, FloatsAreAsStored) {
  const auto file = exr({0.4f, 0.2f, 0.1f, 0.5f});
  EXPECT_THAT(read_stored_image(file).image.values, ElementsAre(0.4f, 0.2f, 0.1f, 0.5f));
  EXPECT_THAT(read_linear_image(file).values, ElementsAre(0.4f, 0.2f, 0.1f));
}

TEST_F(TextureValues, EveryNumberOfAPixel) {
  using enum ImageNumber;
  const auto file = png(4, {51, 102, 204, 153});  // .2 .4 .8, alpha .6
  const double luminance_of_it = 0.212671 * 0.2 + 0.715160 * 0.4 + 0.072169 * 0.8;
  EXPECT_NEAR(number(file, mean), 1.4 / 3, 1e-6);
  EXPECT_NEAR(number(file, luminance), luminance_of_it, 1e-6);
  EXPECT_NEAR(number(file, red), 0.2, 1e-6);
  EXPECT_NEAR(number(file, green), 0.4, 1e-6);
  EXPECT_NEAR(number(file, blue), 0.8, 1e-6);
  for (const ImageNumber by_alpha : {alpha, alpha_or_mean, alpha_or_luminance})
    EXPECT_NEAR(number(file, by_alpha), 0.6, 1e-6);
  EXPECT_NEAR(number(file, alpha, Encoding::automatic), srgb_decode(0.6), 1e-6) << "as pbrt-v4 has it";
  EXPECT_NEAR(number(file, luminance, Encoding::srgb),
              0.212671 * srgb_decode(0.2) + 0.715160 * srgb_decode(0.4) + 0.072169 * srgb_decode(0.8), 1e-6);
  EXPECT_NEAR(number(file, stored_luminance, Encoding::srgb), srgb_decode(luminance_of_it), 1e-6);
}

TEST_F(TextureValues, AlphaThatIsOneEverywhereIsNoNumber) {
  using enum ImageNumber;
  const auto opaque = png(4, {51, 102, 204, 255});
  EXPECT_NEAR(number(opaque, alpha_or_mean), 1.4 / 3, 1e-6);
  EXPECT_NEAR(number(opaque, alpha_or_luminance), 0.212671 * 0.2 + 0.715160 * 0.4 + 0.072169 * 0.8, 1e-6);
  EXPECT_EQ(number(opaque, alpha), 1);
  const auto without = png(3, {51, 102, 204});
  EXPECT_NEAR(number(without, alpha_or_mean), 1.4 / 3, 1e-6);
  EXPECT_EQ(number(without, alpha), 1);
  const auto grey = png(2, {51, 102});
  for (const ImageNumber of_grey : {mean, luminance, red, green, blue, stored_luminance})
    EXPECT_NEAR(number(grey, of_grey), 0.2, 1e-6);
  EXPECT_NEAR(number(grey, alpha_or_luminance), 0.4, 1e-6);
}

TEST_F(TextureValues, ScaleAndInversionComeLast) {
  ImageTexture texture;
  texture.scale = 0.5f, texture.invert = true;
  texture.number = ImageNumber::alpha;
  EXPECT_THAT(values(png(4, {51, 102, 204, 0}), ImageUse::number, texture), ElementsAre(near(1)));
  EXPECT_THAT(values(png(4, {0, 255, 0, 0}), ImageUse::color, texture),
              ElementsAre(near(1), near(0.5), near(1)));
}

TEST_F(TextureValues, VectorsAreTheFilesOwnNumbers) {
  EXPECT_THAT(values(png(4, {51, 102, 204, 9}), ImageUse::vector),
              ElementsAre(near(0.2), near(0.4), near(0.8)));
}

const std::vector<float> aces{0.7347f, 0.2653f, 0, 1, 0.0001f, -0.077f, 0.32168f, 0.33767f};
const std::vector<float> acescg{0.713f, 0.293f, 0.165f, 0.83f, 0.128f, 0.044f, 0.32168f, 0.33767f};

TEST_F(TextureValues, ChromaticitiesOfTheFile) {
  ImageTexture texture;
  // The white of ACES is warm beside D65: so it is to Mitsuba, and as light; pbrt's reflectances are white.
  const auto white = exr({1, 1, 1}, aces);
  const auto d60 = ElementsAre(near(1.047, 3e-3), near(0.995, 3e-3), near(0.915, 3e-3));
  EXPECT_THAT(values(white, ImageUse::color, texture), d60);
  texture.primaries = Primaries::named;
  EXPECT_THAT(values(white, ImageUse::light, texture), d60);
  EXPECT_THAT(values(white, ImageUse::color, texture), ElementsAre(near(1), near(1), near(1)));
  texture.primaries = Primaries::srgb;
  EXPECT_THAT(values(white, ImageUse::light, texture), ElementsAre(1, 1, 1));
}

// One colour in the spaces of film: by the matrices from XYZ that the Academy publishes (S-2008-001,
// S-2014-004).
TEST_F(TextureValues, ColorsOfAcesAreThoseOfSrgb) {
  using Matrix = std::array<std::array<double, 3>, 3>;
  constexpr Matrix to_ap0{
      {{1.0498110175, 0, -0.0000974845}, {-0.4959030231, 1.3733130458, 0.0982400361}, {0, 0, 0.9912520182}}};
  constexpr Matrix to_ap1{{{1.6410233797, -0.3248032942, -0.2364246952},
                           {-0.6636628587, 1.6153315917, 0.0167563477},
                           {0.0117218943, -0.0082844420, 0.9883948585}}};
  constexpr RGB color{0.8, 0.3, 0.1};
  const XYZ xyz = srgb_to_xyz(color);
  const auto in = [&](const Matrix& m) {
    std::vector<float> v;
    for (const auto& row : m)
      v.push_back(static_cast<float>(row[0] * xyz.x + row[1] * xyz.y + row[2] * xyz.z));
    return v;
  };
  const auto same = ElementsAre(near(color.r, 1e-3), near(color.g, 1e-3), near(color.b, 1e-3));
  ImageTexture texture;
  EXPECT_THAT(values(exr(in(to_ap1), acescg), ImageUse::color, texture), same);
  EXPECT_THAT(values(exr(in(to_ap0), aces), ImageUse::color, texture), same);
  EXPECT_THAT(values(exr(in(to_ap0), aces), ImageUse::light, texture), same);
  texture.primaries = Primaries::named;  // a sky by pbrt's makesky
  EXPECT_THAT(values(exr(in(to_ap0), aces), ImageUse::light, texture), same);
}

TEST_F(TextureValues, ChromaticitiesThatPbrtDoesNotKnowSayNothingToIt) {
  ImageTexture texture;
  texture.primaries = Primaries::named;
  const auto file = exr({0.5f, 0.25f, 0.125f}, acescg);
  EXPECT_THAT(values(file, ImageUse::color, texture), ElementsAre(0.5f, 0.25f, 0.125f));
  EXPECT_TRUE(ignores_primaries(texture, read_image_layout(file)));
  texture.primaries = Primaries::file;
  EXPECT_FALSE(ignores_primaries(texture, read_image_layout(file)));
  EXPECT_NE(values(file, ImageUse::color, texture).at(0), 0.5f);
  // Those of sRGB change nothing, bit for bit; those that do not span the plane neither.
  EXPECT_THAT(values(exr({0.5f, 0.25f, 0.125f}, {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f}),
                     ImageUse::color, texture),
              ElementsAre(0.5f, 0.25f, 0.125f));
  EXPECT_THAT(values(exr({0.5f, 0.25f, 0.125f}, {0, 0, 0, 0, 0, 0, 0, 0}), ImageUse::color, texture),
              ElementsAre(0.5f, 0.25f, 0.125f));
}

TEST_F(TextureValues, SameValues) {
  ImageTexture a, b;
  a.filename = b.filename = (folder_ / "none.png").string();
  b.number = ImageNumber::luminance;
  EXPECT_TRUE(have_same_values(a, b, ImageUse::color)) << "without reading the file, which is not there";
  EXPECT_THROW(have_same_values(a, b, ImageUse::number), Error);
  a.filename = b.filename = png(3, {51, 102, 204}).string();
  EXPECT_FALSE(have_same_values(a, b, ImageUse::number));
  png(3, {51, 51, 51});
  EXPECT_TRUE(have_same_values(a, b, ImageUse::number));
  b.encoding = Encoding::srgb;
  EXPECT_TRUE(have_same_values(a, b, ImageUse::color)) << "what integers are without being asked";
  b.encoding = Encoding::linear;
  EXPECT_FALSE(have_same_values(a, b, ImageUse::color));
}

TEST(ImageOf, ALightHasItsEncodingAndNumber) {
  GoniometricLight light;
  light.filename = "a.exr";
  light.encoding = Encoding::srgb;
  light.number = ImageNumber::luminance;
  const ImageTexture image = image_of(light);
  EXPECT_EQ(image.filename, "a.exr");
  EXPECT_EQ(image.encoding, Encoding::srgb);
  EXPECT_EQ(image.number, ImageNumber::luminance);
}

}  // namespace
}  // namespace vitrail::texture_values_test
