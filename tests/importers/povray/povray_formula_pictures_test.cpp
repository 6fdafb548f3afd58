// SPDX-License-Identifier: Apache-2.0
// Patterns that are formulas as povray shows them: on floors and balls, of pigments, textures and normals.
#include "tests/importers/povray/povray_pictures.h"
#include "tests/support/png.h"

namespace vitrail::povray_formula_pictures_test {
namespace {

class PovrayFormulas : public PovrayPictures {
 protected:
  void expect_shown(const std::string& look, double most = 0.02) {
    const std::string functions = "#include \"functions.inc\"\n";
    expect_alike(linear_view + functions + two_lamps + "plane { y, 0 " + look +
                     " }\nsphere { <0, .9, 0>, .8 " + look + " }\n",
                 most);
  }
};

const std::string map = " color_map { [0 rgb <.9, .2, .1>] [.4 rgb <.9, .9, .3>] [1 rgb <.1, .2, .8>] } ";

TEST_F(PovrayFormulas, OfPigments) {
  for (const char* pattern : {"function { sin(x*4)*cos(z*3)/2 + .5 }", "function { f_torus(x, y, z, 1, .4) }",
                              "spiral2 3 rotate x*90 scale .6", "julia <.3, .4>, 20 rotate x*90",
                              "magnet 2 mandel 20 rotate x*90", "slope { y altitude y, 0, 2 }"})
    expect_shown("pigment { " + std::string(pattern) + map + "} finish { ambient .3 }");
  expect_shown(
      "pigment { object { union { sphere { x, .9 } box { -1, <0, .5, 0> } } rgb <.8, .3, .2>, rgb <.2, .3, "
      ".9> } }");
  expect_shown("pigment { cubic rgb x rgb y rgb z rgb x+y rgb y+z rgb x+z rotate 30 }");
}

TEST_F(PovrayFormulas, OfTextures) {
  expect_shown(
      "texture { slope { y, .4, 1 } texture_map { [.3 pigment { rgb <.9, .8, .1> } finish { ambient .5 }]"
      " [.8 pigment { rgb <.1, .2, .9> } finish { specular .8 roughness .05 }] } }");
  expect_shown(
      "texture { object { sphere { <0, .9, -.8>, .6 } texture { pigment { rgb <.9, .2, .1> } finish { "
      "ambient .2 } }"
      " texture { pigment { checker scale .3 } finish { diffuse .9 } } } }");
}

TEST_F(PovrayFormulas, OfNormals) {
  for (const char* normal : {"function { sin(x*9)*sin(z*9)/2 + .5 } .8", "spiral2 3 .5 scale .4 rotate x*90",
                             "function { f_r(x, y, z) } 1 sine_wave frequency 3"})
    expect_shown("pigment { rgb .7 } normal { " + std::string(normal) + " } finish { ambient .1 phong .4 }",
                 0.04);
}

// Around a sphere and a cylinder, as on parts of them and where they are turned.
TEST_F(PovrayFormulas, ImagesAroundThings) {
  folder_.write("a.ppm",
                "P3\n4 3\n255\n255 0 0  0 255 0  0 0 255  255 255 0\n"
                "40 40 40  90 90 90  150 150 150  220 220 220\n0 255 255  255 0 255  255 128 0  128 0 255\n");
  const auto pigment = [](int type, const char* more) {
    return fmt::format(
        " pigment {{ image_map {{ ppm \"a.ppm\" map_type {} {} }} rotate y*30 }}"
        " finish {{ ambient .4 diffuse .5 }} }}\n",
        type, more);
  };
  for (const char* more : {"", "interpolate 2", "once"}) {
    expect_alike(linear_view + two_lamps + "sphere { 0, 1.4" + pigment(1, more), 0.03);
    expect_alike(
        linear_view + two_lamps + "difference { sphere { 0, 1.4 } box { 0, <2, 2, -2> }" + pigment(1, more),
        0.03);
    expect_alike(linear_view + two_lamps + "cylinder { y*.1, y*1.3, 1.2 rotate y*50 " + pigment(2, more),
                 0.03);
    expect_alike(linear_view + two_lamps + "box { <-1, 0, -1>, <1, 1.5, 1> " + pigment(2, more), 0.03);
  }
}

// What is beyond an image that is there once, or where its file is clear, lets one see what is behind.
TEST_F(PovrayFormulas, ImagesWithHoles) {
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < 16; ++i)
    for (int c = 0; c < 4; ++c) rgba.push_back(c == 3 ? (i % 3 == 0 ? 0 : 255) : (c == i % 3 ? 200 : 50));
  test::write_png(folder_ / "holes.png", 4, 4, 4, rgba);
  for (const char* image : {"png \"holes.png\"", "png \"holes.png\" once"})
    expect_alike(
        linear_view + two_lamps +
            "plane { y, 0 pigment { checker rgb .2, rgb .8 } }\nbox { <-1, 0, -1>, <1, 1.5, 1>" +
            fmt::format(" pigment {{ image_map {{ {} }} }} finish {{ ambient .4 diffuse .5 }} }}\n", image),
        0.03);
}

}  // namespace
}  // namespace vitrail::povray_formula_pictures_test
