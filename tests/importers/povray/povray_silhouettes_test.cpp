// SPDX-License-Identifier: Apache-2.0
// What objects cover in povray's pictures, and in ours of the same file: intersection ÷ union.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "film/develop.h"
#include "importers/povray/read/povray.h"
#include "tests/importers/povray/povray_render.h"
#include "tests/support/render.h"

namespace vitrail::povray_silhouettes_test {
namespace {

// Of povray's picture a sample a pixel, in blocks of 8 × 8; ours has a pixel a block.
constexpr int width = 80, height = 60, block = 8;

class PovraySilhouettes : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_povray()) GTEST_SKIP() << "povray is not installed: nothing was rendered";
  }

  std::vector<double> by_povray() {
    const std::string command =
        fmt::format("cd '{}' && povray +Iscene.pov +W{} +H{} -D -GA -A +FP16 +Oout.ppm > log.txt 2>&1",
                    folder_.path().string(), width * block, height * block);
    EXPECT_EQ(std::system(command.c_str()), 0);
    const PovPicture picture = read_ppm(folder_ / "out.ppm");
    std::vector<double> mask(width * height);
    if (picture.values.empty()) return mask;
    for (int y = 0; y < height * block; ++y)
      for (int x = 0; x < width * block; ++x)
        mask[static_cast<std::size_t>(y / block * width + x / block)] +=
            picture.at(x, y)[1] / (block * block);
    return mask;
  }
  std::vector<double> by_vitrail(int samples) {
    Scene scene = read_povray(folder_ / "scene.pov").scene;
    scene.film.width = width, scene.film.height = height, scene.film.crop = {0, width, 0, height};
    RenderOptions options;
    options.picture.samples_per_pixel = samples;
    const Picture picture = develop(test::render(scene, std::move(options)).film);
    std::vector<double> mask;
    for (std::size_t i = 1; i < picture.rgb.values.size(); i += 3)
      mask.push_back(std::clamp(static_cast<double>(picture.rgb.values[i]), 0.0, 1.0));
    return mask;
  }
  void expect_alike(const std::string& text, double least = 0.98) {
    folder_.write("scene.pov",
                  "#version 3.7; global_settings { assumed_gamma 1 }\n"
                  "#default { pigment { rgb 1 } finish { ambient 1 diffuse 0 } }\n" +
                      text);
    const std::vector<double> theirs = by_povray();
    double alike = 0;  // noise only takes from it: what agrees with a quarter of the samples agrees with all
    for (const int samples : {block * block / 4, block * block}) {
      const std::vector<double> ours = by_vitrail(samples);
      double both = 0, either = 0;
      for (std::size_t i = 0; i < theirs.size(); ++i)
        both += std::min(theirs[i], ours[i]), either += std::max(theirs[i], ours[i]);
      ASSERT_GT(either, 20) << text;  // pixels
      alike = both / either;
      fmt::print("{:.4f}\n", alike);
      if (alike > least) break;
    }
    EXPECT_GT(alike, least) << text;
  }

  TemporaryFolder folder_;
};

// Transforms of a camera come after all else in it, wherever they stand.
TEST_F(PovraySilhouettes, CamerasThatAreMoved) {
  const std::string around =
      "box { -.4, .4 rotate y*30 } sphere { <.9, .3, .2>, .3 } sphere { <-.5, -.6, 0>, .2 }\n";
  for (const char* view :
       {"location -4*z translate x look_at <0, .3, 0>", "location -4*z angle 50 scale <1.5, 1, 1> look_at 0",
        "scale <1.5, 1, 1> location <0, .5, -4> angle 50 look_at <.2, 0, 0>",
        "location <0, -1, 4> angle 40 matrix <1, 0, 0, 0, 1, .5, 0, 0, 1, 0, 0, 0> rotate y*30 look_at 0",
        "orthographic location -4*z rotate y*30 look_at <.2, .1, 0>"})
    expect_alike(fmt::format("camera {{ {} }}\n", view) + around);
  expect_alike(
      "#declare View = camera { location -4*z angle 50 look_at 0 scale <1.5, 1, 1> }\n"
      "camera { View rotate y*20 }\n" +
      around);
}

// The first letter begins at x = 0, whatever space its font has before it.
TEST_F(PovraySilhouettes, Texts) {
  for (const char* text :
       {"\"cyrvetic.ttf\" \"iC.\" .2, 0", "\"timrom.ttf\" \"bi\" .2, 0", "\"cyrvetic.ttf\" \" C\" .2, .1*x"})
    expect_alike(fmt::format(
        "camera {{ orthographic location <.5, .3, -4> look_at <.5, .3, 0> right 1.6*x up 1.2*y }}\n"
        "text {{ ttf {} }}\n",
        text));
}

// What clips it says where a surface without end is looked at.
TEST_F(PovraySilhouettes, PolynomialsThatAreClipped) {
  const std::string view = "camera { location <2, 3, -9> look_at 0 angle 50 }\n";
  expect_alike(view + "quadric { <-1, 0, 1>, <0, 0, 0>, <0, 1, 0>, 0 clipped_by { box { -2, 2 } } }\n");
  expect_alike(view +
               "quartic { <0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -.1666, 0, 1, 0, 0, 0, 0, 0, 0, "
               "0, 0, .5, 0, "
               "-1, 0, 0, 0, 0, 0> clipped_by { quadric { <1, 1, 0>, 0, 0, -1 scale 2 } plane { z, 1.4142 } "
               "plane { -z, 0 } } bounded_by { clipped_by } }\n");
}

// They go on to the horizon.
TEST_F(PovraySilhouettes, PolynomialsWithoutEnd) {
  const std::string view = "camera { location <0, 8, -30> look_at <0, 2, 0> angle 60 }\n";
  expect_alike(view + "quadric { <1, 0, 1>, 0, <0, -6, 0>, 0 }\n");      // a bowl
  expect_alike(view + "quadric { <1, -1, 1>, 0, 0, 1 }\n");              // two sheets
  expect_alike(view + "quadric { <0, 1, 1>, 0, 0, -4 rotate y*30 }\n");  // a cylinder
}

// Some of its islands intersect themselves, which CGAL refuses.
TEST_F(PovraySilhouettes, CutFractals) {
  expect_alike(
      "camera { location -6*z look_at 0 angle 30 }\n"
      "intersection { julia_fractal { <-0.54, 0.57, 0.0, -0.37> max_iteration 8 precision 20 cube }\n"
      "  box { <-3, -3, -3>, <3, 3, .2> } }\n",
      0.9);
}

}  // namespace
}  // namespace vitrail::povray_silhouettes_test
