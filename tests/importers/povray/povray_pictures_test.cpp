// SPDX-License-Identifier: Apache-2.0
// Small scenes as povray shows them, and as they are read and rendered here: the means of 8 × 8 blocks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "film/develop.h"
#include "importers/povray/read/povray.h"
#include "scene/spectra/color.h"
#include "tests/importers/povray/povray_render.h"
#include "tests/support/render.h"

namespace vitrail {
namespace {

constexpr int width = 64, height = 48;

class PovrayPictures : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_povray()) GTEST_SKIP() << "povray is not installed: nothing was rendered";
  }

  PovPicture by_povray(const std::string& text) {
    folder_.write("scene.pov", text);
    const std::string command = fmt::format(
        "cd '{}' && povray +Iscene.pov +W{} +H{} -D -GA +A0.0 +AM1 +R4 +FP16 +Oout.ppm "
        "> log.txt 2>&1",
        folder_.path().string(), width, height);
    EXPECT_EQ(std::system(command.c_str()), 0) << text;
    PovPicture picture = read_ppm(folder_ / "out.ppm");
    for (double& v : picture.values) v = srgb_decode(v);  // as a screen shows it, whatever assumed_gamma is
    return picture;
  }
  std::vector<double> by_vitrail(int samples) {
    Scene scene = read_povray(folder_ / "scene.pov").scene;
    scene.film.width = width, scene.film.height = height, scene.film.crop = {0, width, 0, height};
    RenderOptions options;
    options.picture.samples_per_pixel = samples;
    options.picture.integrator = scene.settings.direct_only ? Integrator::direct : Integrator::path;
    const Picture picture = develop(test::render(scene, std::move(options)).film);
    std::vector<double> values(picture.rgb.values.begin(), picture.rgb.values.end());
    for (double& v : values) v = std::min(v, 1.0);  // as in files
    return values;
  }
  static std::vector<double> blocks(const std::vector<double>& values) {
    std::vector<double> means(width / 8 * (height / 8) * 3);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
          means[static_cast<std::size_t>((y / 8 * (width / 8) + x / 8) * 3 + c)] +=
              values[static_cast<std::size_t>((y * width + x) * 3 + c)] / 64;
    return means;
  }
  // The mean difference of the blocks, over the mean of povray's picture.
  void expect_alike(const std::string& text, double most, int samples = 64) {
    const PovPicture picture = by_povray(text);
    ASSERT_FALSE(picture.values.empty());
    const std::vector<double> theirs = blocks(picture.values), ours = blocks(by_vitrail(samples));
    double difference = 0, all = 0;
    for (std::size_t i = 0; i < theirs.size(); ++i)
      difference += std::abs(theirs[i] - ours[i]), all += theirs[i];
    ASSERT_GT(all, 0);
    fmt::print("{:.2f} %\n", 100 * difference / all);
    EXPECT_LT(difference / all, most) << text;
  }

  TemporaryFolder folder_;
};

const std::string camera = "camera { location <0, 1.5, -4> look_at <0, 0.7, 0> }\n";
const std::string linear = "#version 3.7; global_settings { assumed_gamma 1 }\n" + camera;
const std::string lamps =
    "light_source { <-3, 5, -4> rgb <.8, .7, .6> } light_source { <4, 3, -2> rgb <.2, .3, .4> }\n";

// A ball on a floor in two lights, with ambient and a mirror.
const std::string ball =
    lamps +
    "plane { y, 0 pigment { checker rgb <.8, .7, .6>, rgb <.3, .4, .2> } finish { ambient .15 diffuse .7 } "
    "}\n"
    "sphere { <-.6, .7, 0>, .7 pigment { rgb <.9, .4, .2> } finish { ambient .2 diffuse .6 } }\n"
    "sphere { <.9, .6, -.3>, .6 pigment { gradient y color_map { [0 rgb <.1, .3, .9>] [1 rgb 1] } }"
    " finish { ambient .1 diffuse .5 reflection .3 } }\n";

TEST_F(PovrayPictures, SumsOfColorsOfAScreen) {
  for (const char* head : {"#version 3.7; global_settings { assumed_gamma 1 }",
                           "#version 3.7; global_settings { assumed_gamma 2.2 }",
                           "#version 3.7; global_settings { assumed_gamma 1.5 }",
                           "#version 3.7; global_settings { assumed_gamma srgb }", "#version 3.7;",
                           "#version 3.6;", "#version 3.6; global_settings { assumed_gamma 2.2 }"})
    expect_alike(std::string(head) + "\n" + camera + ball, 0.02);
}

TEST_F(PovrayPictures, ImagesInEachGamma) {
  folder_.write("a.ppm", "P3\n2 2\n255\n255 128 64  32 200 90\n 10 60 240  128 128 128\n");
  const std::string wall =
      "plane { z, 0 pigment { image_map { ppm \"a.ppm\"@ } translate <.5, 0, 0> scale 2 }"
      " finish { ambient .3 diffuse .6 } }\n";
  const auto with = [&](const std::string& more) {
    std::string text = wall;
    return text.replace(text.find('@'), 1, more);
  };
  for (const char* head : {"#version 3.7; global_settings { assumed_gamma 1 }",
                           "#version 3.7; global_settings { assumed_gamma 2.2 }",
                           "#version 3.6; global_settings { assumed_gamma 1 }", "#version 3.6;",
                           "#version 3.6; global_settings { assumed_gamma 2.2 }"})
    for (const char* more : {"", " gamma 1.0"})
      expect_alike(std::string(head) + "\n" + camera + lamps + with(more), 0.03);
}

TEST_F(PovrayPictures, Highlights) {
  const auto shown = [&](const std::string& finish, const std::string& normal) {
    return linear + lamps + "plane { y, 0 pigment { rgb .5 } " + normal + " finish { ambient .1 " + finish +
           " } }\nsphere { <0, .9, 0>, .8 pigment { rgb <.9, .4, .2> } " + normal + " finish { ambient .1 " +
           finish + " } }\n";
  };
  for (const char* finish :
       {"phong .8 phong_size 20", "specular .7 roughness .03", "specular .6 roughness .2",
        "specular .8 roughness .05 metallic", "brilliance 3 phong .4 phong_size 60"})
    expect_alike(shown(finish, ""), 0.02);
  expect_alike(shown("specular .8 roughness .03", "normal { ripples .6 scale .3 }"), 0.04);
  expect_alike(shown("phong .8 phong_size 30", "normal { gradient x .4 sine_wave scale .2 }"), 0.04);
}

TEST_F(PovrayPictures, Shadows) {
  expect_alike(linear + ball + "light_source { <0, 6, 3> rgb .4 shadowless }", 0.02);
  expect_alike(linear + ball +
                   "box { <-1, 1.6, -1>, <1, 1.7, 0> no_shadow pigment { rgb .7 } finish { specular .5 } }",
               0.02);
}

// Each shape from both sides, red outside and blue inside. Of triangles the order of the corners decides.
TEST_F(PovrayPictures, TexturesOfTheInside) {
  const std::string sides =
      " texture { pigment { rgb <.8,.1,.1> } finish { ambient 0 diffuse .9 } }"
      " interior_texture { pigment { rgb <.1,.2,.9> } finish { ambient 0 diffuse .9 } } }\n";
  for (const std::string shape :
       {"sphere { <0,.7,0>, 1 clipped_by { plane { z, 0 } }",
        "sphere { <0,.7,0>, 1 clipped_by { plane { -z, 0 } }",
        "cylinder { <-1,.7,0>, <1,.7,0>, .7 open rotate 60*y", "disc { <0,.7,0>, z, 1",
        "disc { <0,.7,0>, -z, 1", "mesh { triangle { <-1,0,0>, <1,0,0>, <0,1.5,0> }",
        "mesh { triangle { <1,0,0>, <-1,0,0>, <0,1.5,0> }",
        "mesh2 { vertex_vectors { 3, <-1,0,0>, <1,0,0>, <0,1.5,0> } face_indices { 1, <0,1,2> }",
        "difference { box { <-1,0,-1>, <1,1.4,1> } box { <-.8,.2,-2>, <.8,1.2,.8> }"})
    expect_alike(linear + "background { rgb 1 } " + lamps + shape + sides, 0.02);
}

// A triangle that glows outside alone.
TEST_F(PovrayPictures, LightOfTheOutside) {
  for (const std::string corners : {"<-1,0,0>, <1,0,0>", "<1,0,0>, <-1,0,0>"})
    expect_alike(linear + lamps + "mesh { triangle { " + corners +
                     ", <0,1.5,0> } texture { pigment { rgb .2 } finish { emission .6 diffuse 1 } }"
                     " interior_texture { pigment { rgb .2 } finish { ambient 0 diffuse 1 } } }",
                 0.02);
}

TEST_F(PovrayPictures, Atmospheres) {
  const std::string walls = ball + "plane { -z, -6 pigment { rgb .6 } }\n";
  for (const char* media :
       {"media { absorption <.05, .1, .15> }", "media { emission .03 }",
        "fog { distance 8 rgb <.4, .5, .6> }", "media { scattering { 1, .05 extinction .2 } }"})
    expect_alike(linear + walls + media, 0.03, 256);
  for (const char* media :
       {"media { scattering { 1, .06 } }", "media { scattering { 5, .05 eccentricity .4 } }"})
    expect_alike(linear + walls + media, 0.08, 256);
  // What is not hollow keeps it out, from the eye as well.
  const std::string clear = " pigment { rgbt 1 } finish { ambient 0 diffuse 0 } no_shadow }\n";
  expect_alike(linear + walls + "fog { distance 4 rgb <.4, .5, .6> } sphere { <0, 1, -1>, .9" + clear, 0.03);
  expect_alike(linear + walls + "fog { distance 4 rgb <.4, .5, .6> } sphere { <0, 1, -1>, .9 hollow" + clear,
               0.03);
  expect_alike(
      linear + walls + "fog { distance 4 rgb <.4, .5, .6> } sphere { 0, 90 pigment { rgb 1 } no_shadow }",
      0.03);
}

TEST_F(PovrayPictures, Cameras) {
  const std::string around =
      "light_source { <1, 2, -1> rgb 1 }\nbox { -4, 4 pigment { checker rgb <.9, .3, .2>, rgb <.2, .4, .9> "
      "scale 1.3 }"
      " finish { ambient .4 diffuse .4 } }\n";
  for (const char* kind :
       {"spherical", "spherical angle 160 80", "fisheye angle 150", "ultra_wide_angle angle 140", "panoramic",
        "cylinder 1 angle 130", "cylinder 2 angle 130", "cylinder 3 angle 130", "cylinder 4 angle 130"})
    expect_alike(
        fmt::format("#version 3.7; global_settings {{ assumed_gamma 1 }}\ncamera {{ {} location <.3, .2, -1> "
                    "look_at <0, 0, 2> }}\n",
                    kind) +
            around,
        0.03);
}

}  // namespace
}  // namespace vitrail
