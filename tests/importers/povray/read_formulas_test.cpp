// SPDX-License-Identifier: Apache-2.0
// Patterns that become formulas of the Scene, against povray's pictures of planes and balls that glow by
// them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "importers/povray/read/povray.h"
#include "scene/models/pattern.h"
#include "scene/models/texture_mapping.h"
#include "tests/importers/povray/povray_render.h"

namespace vitrail::read_formulas_test {
namespace {

constexpr int side = 32;

class ReadFormulas : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_povray()) GTEST_SKIP() << "povray is not installed: nothing was rendered";
  }
  // `shape` without its closing brace.
  void show(const std::string& before, const std::string& shape, const std::string& pigment) {
    folder_.write("scene.pov",
                  "#version 3.7; global_settings { assumed_gamma 1 }\n#include \"functions.inc\"\n"
                  "camera { orthographic location -4*z direction z up 4*y right 4*x }\n" +
                      before + "\n" + shape + " pigment { " + pigment +
                      " } finish { ambient 0 emission 1 diffuse 0 } }\n");
    const std::string command = fmt::format(
        "cd '{}' && povray +Iscene.pov +W{} +H{} -D -GA -A +FP16 File_Gamma=1.0 +Oout.ppm > log.txt 2>&1",
        folder_.path().string(), side, side);
    ASSERT_EQ(std::system(command.c_str()), 0) << pigment;
    picture_ = read_ppm(folder_ / "out.ppm");
    scene_ = read_povray(folder_ / "scene.pov").scene;
    formula_ = nullptr;
    for (const Texture& texture : scene_.textures)
      if (const auto* t = std::get_if<PatternTexture>(&texture.model);
          t && t->kind == PatternTexture::Kind::formula)
        formula_ = t;
    ASSERT_NE(formula_, nullptr) << pigment;
    ASSERT_EQ(fault_of(*formula_), nullptr) << pigment;
  }
  double value(Point3d p, Vector3d n) const {
    const auto brightness = [&](std::size_t i) {
      return evaluate(std::get<Spectrum>(formula_->map.at(i).value), 550) /
             evaluate(emission_from_rgb({1, 1, 1}), 550);
    };
    const PatternMix mix = pattern_mix(*formula_, transform_point(inverse(formula_->texture_to_world), p), n);
    return (1 - mix.amount) * brightness(mix.first) + mix.amount * brightness(mix.second);
  }
  // But for so many pixels, whose middle is at an edge.
  void expect_plane(const std::string& pigment, const std::string& before = "", int edges = 4) {
    ASSERT_NO_FATAL_FAILURE(show(before, "plane { z, 0", pigment));
    int unlike = 0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        unlike += !(std::abs(value({plane_x(x), plane_y(y), 0}, {0, 0, -1}) - picture_.at(x, y)[0]) < 3e-3);
    EXPECT_LE(unlike, edges) << pigment;
  }
  void expect_ball(const std::string& pigment) {
    constexpr double radius = 1.9;
    ASSERT_NO_FATAL_FAILURE(show("", fmt::format("sphere {{ 0, {}", radius), pigment));
    int unlike = 0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const double px = plane_x(x), py = plane_y(y), rest = radius * radius - px * px - py * py;
        if (rest < 0.1) continue;
        const Point3d p{px, py, -std::sqrt(rest)};
        unlike += !(std::abs(value(p, (p - Point3d{}) * (1 / radius)) - picture_.at(x, y)[0]) < 3e-3);
      }
    EXPECT_LE(unlike, 6) << pigment;
  }

  TemporaryFolder folder_;
  PovPicture picture_;
  Scene scene_;
  const PatternTexture* formula_ = nullptr;
};

const std::string map = " color_map { [0 rgb 0] [1 rgb 1] }";

TEST_F(ReadFormulas, Operators) {
  for (const char* formula :
       {"x*3", "-x/2 + y", "x/(y - y)", "(x < .3) * .2 + (y > 0) * .4 + (x*y >= .5) * .1 + (x <= y) * .2",
        "((x > 0) & (y > 0)) * .3 + ((x > 1) | (y > 1)) * .4", "select(x, y*y, .5, x*y)",
        "select(y, .2, .7)"})
    expect_plane(fmt::format("function {{ {} }}", formula) + map);
}

TEST_F(ReadFormulas, FunctionsOfNumbers) {
  for (const char* formula :
       {"sin(x*3)*cos(y*2)/2 + .5", "min(abs(x), max(y, .2), .9)", "mod(x*2, .7)", "atan2(y, x)/7 + .5",
        "pow(abs(x), 1.7)/4 + pow(y, 2)/8", "sqrt(x*x + y*y)/3 + exp(-x*x)/9", "ln(1.1 + y*y)/2",
        "log(3 + x) + int(y*2)/9", "floor(x)/5 + ceil(y)/7 + .5", "tan(x/3)/3 + .5 + tanh(y)/9",
        "asin(x/2)/4 + .5 + acos(y/2)/9", "atan(x)/4 + sinh(y)/9 + cosh(x)/9",
        "degrees(x)/400 + radians(y) + .5", "acosh(1 + x*x)/3 + asinh(y)/9 + .2", "atanh(x/2.1)/5 + .5",
        "div(x*5, 2)/7 + .4"})
    expect_plane(fmt::format("function {{ {} }}", formula) + map, "", 12);
}

TEST_F(ReadFormulas, FunctionsOfTheInclude) {
  for (const char* formula :
       {"f_sphere(x, y, z, .4)/2", "f_torus(x, z, y, 1.2, .3)/2 + .4", "f_r(x, y, z)/3",
        "f_th(x, y, y)/7 + .5", "f_ph(x, y, z)/4", "f_ellipsoid(x, y, z, .3, .5, 1)",
        "f_paraboloid(x, y, z, .2)/3 + .5", "f_rounded_box(x, y, z, .2, 1, .7, .5)/2 + .15",
        "f_superellipsoid(x, y, z, .6, .4)/2 + .5"})
    expect_plane(fmt::format("function {{ {} }}", formula) + map);
}

TEST_F(ReadFormulas, FunctionsOfOthers) {
  const std::string others =
      "#declare F = function(a, b) { a*a - b/3 } #declare G = function { F(F(x, y), y*.5)/4 + .5 }\n"
      "#declare P = function { pigment { gradient x color_map { [0 rgb <.1,.5,.9>] [.6 rgb <1,.2,.3>] [1 rgb "
      "0] }"
      " scale 1.5 rotate z*20 translate .1*y } }\n"
      "#declare N = function { pigment { checker pigment { wood scale .3 color_map { [0 rgb .1] [1 rgb "
      "<.9,.5,.2>] } }"
      " pigment { gradient y pigment_map { [0 rgb 1] [1 onion color_map { [0 rgb x] [1 rgb y] } ] } } scale "
      ".9 } }\n"
      "#declare A = function { pigment { average pigment_map { [1 leopard scale .2] [3 radial color_map { [0 "
      "rgb 0] [1 rgb 1] } rotate x*90] } "
      "} }\n"
      "#declare L = function { pattern { leopard scale .3 rotate z*20 } }\n"
      "#declare C = function { pattern { checker scale .7 } }\n"
      "#declare T = function { transform { rotate z*30 scale <2, 1, 1> translate .2*x } }\n"
      "#declare S = function { spline { linear_spline -2, <.1, .9>, -.5, <.8, .2>, 1, <.3, .4>, 2, <1, 0> } "
      "}\n"
      "#declare Q = function { spline { cubic_spline -3, <.1, .9>, -2, <.6, .2>, .3, <.8, .2>, 2, <.3, .4>,"
      " 3, <1, 0> } }\n";
  for (const char* formula :
       {"G(x, y, z)", "P(x, y, z).red * P(y, x, 0).blue", "P(x*x, y, z).gray", "N(x, y, z).x",
        "N(x, y, z).green", "A(x, y, z).red", "L(x, y, z)/2 + L(y, z, x)/3", "C(x, y, z)*.4 + .2",
        "T(x, y, z).x/8 + T(x, y, z).y/9 + .5", "S(x).u/2 + S(y).v/3", "Q(x).u/2 + Q(y).v/3"})
    expect_plane(fmt::format("function {{ {} }}", formula) + map, others, 8);
}

TEST_F(ReadFormulas, Waves) {
  for (const char* wave :
       {"frequency 1.5", "frequency 1.5 phase .2", "triangle_wave", "sine_wave frequency 2",
        "scallop_wave scale 2", "poly_wave 3 rotate z*40", "cubic_wave translate .3"})
    expect_plane("function { x*1.4 + y/3 } " + map + std::string(wave), "", 8);
  // A number of 1 stays one.
  expect_plane("function { min(abs(x), 1) }" + map);
}

TEST_F(ReadFormulas, Fractals) {
  for (const char* fractal :
       {"julia <.3, .4>, 20", "mandel 20 exponent 3", "julia <.3, .4>, 20 exponent 4", "magnet 1 mandel 20",
        "magnet 2 mandel 20", "magnet 1 julia <.3, .4>, 20", "magnet 2 julia <.3, .4>, 20",
        "mandel 20 exterior 0, .3 interior 1, .3", "mandel 12 exterior 2, .3 interior 2, .3",
        "mandel 12 exterior 3, .3 interior 4, .3", "julia <-.2, .7>, 12 exterior 5, .1 interior 6, .3",
        "magnet 1 mandel 12 interior 1, .2"})
    expect_plane(fractal + map, "", 10);
}

TEST_F(ReadFormulas, Spirals) {
  for (const char* spiral : {"spiral2 3", "spiral2 4 ramp_wave translate -.3*z",
                             "spiral2 -2 sine_wave frequency 2 rotate <20, 30, 0>"})
    expect_plane(spiral + map, "", 10);
}

TEST_F(ReadFormulas, Lists) {
  expect_plane("square rgb 0 rgb .3 rgb .6 rgb 1 rotate x*90 scale .7");
  expect_plane("cubic rgb 0 rgb .2 rgb .4 rgb .6 rgb .8 rgb 1 rotate <30, 40, 0> translate <.1, .2, .3>");
  for (const char* object :
       {"sphere { <.2, .3, 0>, 1 }", "box { -1, <.7, .9, 1> rotate z*30 }", "plane { x, .3 }",
        "cylinder { -1*x, <1, 1, 0>, .6 }", "cone { -y, 1.2, y, .3 translate .2*x }",
        "difference { sphere { 0, 1.5 } box { -.5, 2 } sphere { -1, .9 } }",
        "intersection { sphere { 0, 1 } plane { y, .2 } inverse }",
        "union { sphere { -.8*x, .7 } sphere { .8*x, .7 } }",
        "sphere { 0, 1.4 clipped_by { plane { x + y, .5 } } }"})
    expect_plane("object { " + std::string(object) + " rgb .2, rgb .9 } scale 1.1");
}

// Of a ball, the pixel of an image that lies around it, by map_type 1 or 2.
TEST_F(ReadFormulas, PlacesInImagesAroundThings) {
  constexpr int columns = 8, rows = 4;
  constexpr double radius = 1.9;
  std::string pixels = fmt::format("P3\n{} {}\n255\n", columns, rows);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) pixels += fmt::format("{} {} 0 ", 30 * column, 60 * row);
  folder_.write("a.ppm", pixels);
  for (const int type : {1, 2})
    for (const char* turned : {"", "rotate <20, 50, 0>", "scale <1, 2, 1> translate -.7*y"}) {
      folder_.write(
          "scene.pov",
          fmt::format("#version 3.7; global_settings {{ assumed_gamma 1 }}\n"
                      "camera {{ orthographic location -4*z direction z up 4*y right 4*x }}\n"
                      "sphere {{ 0, {} pigment {{ image_map {{ ppm \"a.ppm\" gamma 1 map_type {} }} {} }}"
                      " finish {{ ambient 0 emission 1 diffuse 0 }} }}\n",
                      radius, type, turned));
      const std::string command = fmt::format(
          "cd '{}' && povray +Iscene.pov +W{} +H{} -D -GA -A +FP16 File_Gamma=1.0 +Oout.ppm > log.txt 2>&1",
          folder_.path().string(), side, side);
      ASSERT_EQ(std::system(command.c_str()), 0);
      const PovPicture picture = read_ppm(folder_ / "out.ppm");
      const Scene scene = read_povray(folder_ / "scene.pov").scene;
      const auto& image = std::get<ImageTexture>(scene.textures.at(0).model);
      PreparedMapping mapping{image.mapping, {}};
      if (const auto* globe = std::get_if<GlobeMapping>(&image.mapping))
        mapping.world_to_texture = inverse(globe->texture_to_world);
      else
        mapping.world_to_texture = inverse(std::get<CylindricalMapping>(image.mapping).texture_to_world);
      int unlike = 0, all = 0;
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          const double px = plane_x(x), py = plane_y(y), rest = radius * radius - px * px - py * py;
          if (rest < 0.1) continue;
          const MappedPoint at = map_point(mapping, {}, {px, py, -std::sqrt(rest)});
          const double column = std::floor((at.s - std::floor(at.s)) * columns),
                       row = rows - 1 - std::floor((at.t - std::floor(at.t)) * rows);
          unlike += !(std::abs(picture.at(x, y)[0] - 30 * column / 255) < 0.02 &&
                      std::abs(picture.at(x, y)[1] - 60 * row / 255) < 0.02);
          ++all;
        }
      EXPECT_LE(unlike, all / 100) << type << " " << turned;
    }
}

TEST_F(ReadFormulas, Slopes) {
  for (const char* slope :
       {"slope y", "slope { y, .3, .8 }", "slope { y altitude y }",
        "slope { <1, 2, -1>, 0, .5 altitude y, -1, 2 }", "slope { x altitude z } scale 2 translate .5",
        "slope { y altitude 2*y }", "slope { -z } frequency 2 phase .25 rotate 90*z"})
    expect_ball(slope + map);
}

// A formula of an image is not held. Its mean is of what it gives, not of all that its map could give.
TEST(ReadFormulasOfImages, AreTheMeanOfWhatTheyShow) {
  const TemporaryFolder folder;
  folder.write("a.ppm", "P3\n2 2\n255\n255 0 0  0 0 0\n 0 0 0  255 0 0\n");
  folder.write("scene.pov",
               "#version 3.7; global_settings { assumed_gamma 1 }\n"
               "#declare F = function { pigment { image_map { ppm \"a.ppm\" gamma 1.0 } } }\n"
               "sphere { 0, 1 pigment { function { F(x, y, z).red / 1000 }"
               " color_map { [0 rgb 0] [1 rgb 4000] } } finish { ambient 0 emission 1 diffuse 0 } }\n");
  const Scene scene = read_povray(folder / "scene.pov").scene;
  ASSERT_EQ(scene.area_lights.size(), 1u);
  const auto* const glow = std::get_if<Spectrum>(&scene.area_lights[0].radiance);
  ASSERT_TRUE(glow);
  const double white = evaluate(emission_from_rgb({1, 1, 1}), 550);
  EXPECT_NEAR(static_cast<double>(scene.area_lights[0].scale) * evaluate(*glow, 550) / white, 4 * .5, .1);
}

}  // namespace
}  // namespace vitrail::read_formulas_test
