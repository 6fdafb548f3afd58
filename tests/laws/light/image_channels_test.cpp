// SPDX-License-Identifier: Apache-2.0
// Pictures of images with alpha and with colours for numbers: as pbrt's sources say, and as Mitsuba shows
// them.
#include <gtest/gtest.h>

#include <cmath>

#include "images/image_files.h"
#include "importers/mitsuba/read/mitsuba.h"
#include "importers/pbrt/read/pbrt.h"
#include "importers/pbrt/write/write_pbrt.h"
#include "tests/importers/mitsuba/mitsuba_oracle.h"
#include "tests/support/paths.h"
#include "tests/support/png.h"
#include "tests/support/render.h"

namespace vitrail::image_channels_test {
namespace {

// The mean linear sRGB of one of the four quarters of a square picture: 0 the upper left, 1 the upper right …
using Quarters = std::array<RGB, 4>;

Quarters quarters(int width, const std::function<RGB(int x, int y)>& pixel) {
  Quarters sums{};
  for (int y = 0; y < width; ++y)
    for (int x = 0; x < width; ++x) {
      const RGB c = pixel(x, y);
      RGB& sum = sums.at(static_cast<std::size_t>((2 * y >= width ? 2 : 0) + (2 * x >= width ? 1 : 0)));
      const double count = width * width / 4.0;
      sum = {sum.r + c.r / count, sum.g + c.g / count, sum.b + c.b / count};
    }
  return sums;
}

Quarters rendered(const Scene& scene, int samples = 64) {
  const Film film = test::render(scene, samples).film;
  return quarters(scene.film.width, [&](int x, int y) {
    return xyz_to_srgb(film.mean(static_cast<std::uint32_t>(y * scene.film.width + x)));
  });
}

void expect_equal(const Quarters& found, const Quarters& expected, double tolerance) {
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(found[i].r, expected[i].r, tolerance) << "red, quarter " << i;
    EXPECT_NEAR(found[i].g, expected[i].g, tolerance) << "green, quarter " << i;
    EXPECT_NEAR(found[i].b, expected[i].b, tolerance) << "blue, quarter " << i;
  }
}

// Two by two pixels, the upper two with alpha 0, the lower two opaque.
const std::vector<std::uint8_t> leaf{40, 80, 20, 0, 40, 80, 20, 0, 40, 80, 20, 255, 40, 80, 20, 255};

class ImageChannels : public testing::Test {
 protected:
  // A square that fills the picture, with uv from its lower left corner, under a white sky of luminance 1.
  Scene pbrt(const std::string& material, const std::string& shape = "") {
    return read_pbrt(
               folder_.write("scene.pbrt",
                             "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 "
                             "PixelFilter \"box\"\n"
                             "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 22.6198649\n"
                             "WorldBegin LightSource \"infinite\" \"rgb L\" [1 1 1]\n" +
                                 material +
                                 "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0 1 -1 0 -1 1 0 1 1 0] "
                                 "\"point2 uv\" [0 0 1 0 0 1 1 1] " +
                                 shape))
        .scene;
  }
  static std::string imagemap(const char* kind, const std::string& filter = "point") {
    return std::string("Texture \"t\" \"") + kind +
           "\" \"imagemap\" \"string filename\" \"a.png\" \"string wrap\" \"clamp\" \"string filter\" \"" +
           filter + "\"\n";
  }
  TemporaryFolder folder_;
};

Quarters grey(double upper, double lower) {
  return {RGB{upper, upper, upper}, {upper, upper, upper}, {lower, lower, lower}, {lower, lower, lower}};
}

TEST_F(ImageChannels, ColorsUnderTransparentAlphaStay) {
  test::write_png(
      folder_ / "a.png", 2, 2, 4,
      std::vector<std::uint8_t>{200, 200, 200, 0, 200, 200, 200, 0, 200, 200, 200, 0, 200, 200, 200, 0});
  const Scene scene = pbrt(imagemap("spectrum") + "Material \"diffuse\" \"texture reflectance\" \"t\"\n");
  expect_equal(rendered(scene), grey(0.5776, 0.5776), 0.01);
}

// pbrt-v4 opens a leaf by its alpha, whatever its colour.
TEST_F(ImageChannels, ALeafIsCutOutByItsAlpha) {
  test::write_png(folder_ / "a.png", 2, 2, 4, leaf);
  const std::string black = "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n";
  Scene scene = pbrt(imagemap("float", "bilinear") + black, "\"texture alpha\" \"t\"");
  for (Texture& t : scene.textures) std::get<ImageTexture>(t.model).filter = TextureFilter::nearest;
  expect_equal(rendered(scene), grey(1, 0), 0.02);
}

TEST_F(ImageChannels, WithoutAlphaItIsTheMeanOfColors) {
  test::write_png(folder_ / "a.png", 2, 2, 3,
                  std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255});
  const std::string black = "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n";
  Scene scene = pbrt(imagemap("float", "bilinear") + black, "\"texture alpha\" \"t\"");
  for (Texture& t : scene.textures) std::get<ImageTexture>(t.model).filter = TextureFilter::nearest;
  expect_equal(rendered(scene, 1024), grey(2.0 / 3, 0), 0.02);
}

// ---- Mitsuba

class MitsubaImageChannels : public ImageChannels {
 protected:
  void SetUp() override {
    if (mitsuba_python().empty()) GTEST_SKIP() << "skipped: Mitsuba 3 is not installed";
  }
  // The same square; `inside` are its emitter and bsdf.
  std::filesystem::path xml(const std::string& inside) {
    return folder_.write(
        "scene.xml",
        "<scene version='3.0.0'><integrator type='path'><integer name='max_depth' value='3'/></integrator>"
        "<sensor type='perspective'><float name='fov' value='22.6198649'/><transform name='to_world'>"
        "<lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform><film type='hdrfilm'>"
        "<integer name='width' value='8'/><integer name='height' value='8'/>"
        "<string name='pixel_format' value='rgb'/><string name='component_format' value='float32'/>"
        "<rfilter type='box'/></film></sensor><shape type='rectangle'>" +
            inside + "</shape><emitter type='constant'><rgb name='radiance' value='1'/></emitter></scene>");
  }
  Quarters shown_by_mitsuba(const std::filesystem::path& scene, const char* variant = "scalar_spectral",
                            int samples = 1024) {
    const std::string out = (folder_ / "mitsuba.exr").string();
    const std::string command = mitsuba_python() + " " +
                                test::project_file("tests/importers/render_mitsuba.py ") + scene.string() +
                                " " + out + " --spp " + std::to_string(samples) + " --variant " + variant;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    const Image picture = read_linear_image(out);
    return quarters(picture.width, [&](int x, int y) {
      const float* v = &picture.values[static_cast<std::size_t>(3 * (y * picture.width + x))];
      return RGB{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    });
  }
};

TEST_F(MitsubaImageChannels, ColorsUnderTransparentAlphaStay) {
  test::write_png(folder_ / "a.png", 2, 2, 4, leaf);
  const auto scene = xml(
      "<bsdf type='twosided'><bsdf type='diffuse'><texture type='bitmap' name='reflectance'><string "
      "name='filename' value='a.png'/><string name='filter_type' value='nearest'/></texture></bsdf></bsdf>");
  expect_equal(rendered(read_mitsuba(scene).scene, 256), shown_by_mitsuba(scene), 0.005);
}

// A colour image as a number: luminance of what is decoded.
TEST_F(MitsubaImageChannels, ANumberIsTheLuminance) {
  test::write_png(folder_ / "a.png", 2, 2, 3,
                  std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 200, 200, 100});
  for (const bool raw : {false, true}) {
    const auto scene = xml(
        std::string(
            "<bsdf type='mask'><texture type='bitmap' name='opacity'><string name='filename' "
            "value='a.png'/><string name='filter_type' value='nearest'/><boolean name='raw' value='") +
        (raw ? "true" : "false") +
        "'/></texture><bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>"
        "</bsdf></bsdf>");
    expect_equal(rendered(read_mitsuba(scene).scene, 1024), shown_by_mitsuba(scene, "scalar_rgb", 4096),
                 0.02);
  }
}

// An image of light is the right way up here, and in what is written for pbrt.
TEST_F(MitsubaImageChannels, ImagesOfLightStandUpright) {
  Image image = black_image(2, 2, 3);
  image.values = {8, 1, 1, 1, 8, 1, 1, 1, 8, 5, 5, 5};
  write_exr_image(folder_ / "a.exr", image);
  const auto scene =
      xml("<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf><emitter type='area'><texture "
          "name='radiance' type='d65'><texture type='bitmap' name='nested'><string name='filename' "
          "value='a.exr'/><string name='wrap_mode' value='clamp'/></texture></texture></emitter>");
  const Quarters expected = shown_by_mitsuba(scene, "scalar_rgb");
  const Scene read = read_mitsuba(scene).scene;
  expect_equal(rendered(read), expected, 0.15);
  write_pbrt(read, folder_ / "out.pbrt");
  expect_equal(rendered(read_pbrt(folder_ / "out.pbrt").scene), expected, 0.15);
}

}  // namespace
}  // namespace vitrail::image_channels_test
