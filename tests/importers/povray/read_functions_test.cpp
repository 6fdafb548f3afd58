// SPDX-License-Identifier: Apache-2.0
// Functions of pigments, patterns, transformations and splines; trace(), inside() and extents. Numbers are
// those that povray 3.7 prints.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "importers/povray/read/povray.h"
#include "importers/povray/read/reader.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::read_functions_test {
namespace {

class ReadFunctions : public ::testing::Test {
 protected:
  std::vector<double> values(const std::string& expression, const std::string& before = "") {
    const auto path = folder_.path() / "scene.pov";
    std::ofstream(path) << "#version 3.7;\n" + before + "\n#declare Result_ = " + expression + ";\n";
    pov::Reader reader(path, {{folder_.path()}}, {});
    while (reader.next().kind != pov::TokenKind::end) {
    }
    const auto n = std::get<pov::Numbers>(*reader.symbols().find("Result_")->value());
    return {n.v.begin(), n.v.begin() + n.terms};
  }
  void expect(const std::string& expression, std::vector<double> wanted, const std::string& before = "") {
    const std::vector<double> got = values(expression, before);
    wanted.resize(got.size());
    for (std::size_t i = 0; i < got.size(); ++i)
      EXPECT_NEAR(got[i], wanted[i], 3e-5) << expression << " " << i;
  }
  void expect_value(const std::string& pattern, const std::string& at, double wanted) {
    expect("F" + at, {wanted}, "#declare F = function { pattern { " + pattern + " } }");
  }
  int tiling_notes(const std::string& scene) {
    const auto path = folder_.path() / "scene.pov";
    std::ofstream(path) << "#version 3.7;\n" + scene + "\n";
    const Diagnostics notes = read_povray(path).diagnostics;
    return static_cast<int>(std::ranges::count_if(
        notes, [](const Diagnostic& d) { return d.message.find("tiling") != std::string::npos; }));
  }
  // Two by two: red, green; blue, grey of 128.
  void write_image() {
    const std::string pixels("\xff\0\0\0\xff\0\0\0\xff\x80\x80\x80", 12);
    std::ofstream(folder_.path() / "i.ppm", std::ios::binary) << "P6 2 2 255\n" << pixels;
  }
  TemporaryFolder folder_;
};

TEST_F(ReadFunctions, PigmentsGiveColours) {
  const std::string pigment =
      "#declare P = function { pigment { gradient x color_map { [0 rgb <.1,.5,.9>] [1 rgb <1,.2,.3>] } } }";
  expect("P(0.25,0,0)", {0.325, 0.425, 0.75}, pigment);
  expect("F(0.25,0,0)", {0.432350}, pigment + "#declare F = function { P(x,y,z).gray }");
  expect("F(0.25,0,0)", {0.325390}, pigment + "#declare F = function { P(x,y,z).hf }");
  expect("F(1)", {2 * 0.425 + 1},
         pigment + "#declare F = function(s) { 2*P(s/4,0,0).green + select(P(s,0,0).x, 0, 1, 1) }");
  expect("P(1,1,1)", {1, 0.25, 0.25},
         "#declare P = function { pigment { average pigment_map { [1 rgb 1] [3 rgb x] } } }");
  expect("P(1.5,.5,.5)", {0, 1, 0}, "#declare P = function { pigment { checker rgb x, rgb y } }");
  expect("P(0,0,0)", {0, 1, 0}, "#declare P = function { pigment { object { sphere {0,1} rgb x, rgb y } } }");
  expect("P(2,0,0)", {1, 0, 0}, "#declare P = function { pigment { object { sphere {0,1} rgb x, rgb y } } }");
}

// functions.inc declares dozens that a scene never calls; what they approximate is said where one is used.
TEST_F(ReadFunctions, NotesAreOfThoseThatAreUsed) {
  const std::string declared =
      "#declare N = function { pattern { tiling 3 } } #declare M = function { N(x,y,z) + 1 }\n";
  EXPECT_EQ(tiling_notes(declared), 0);
  EXPECT_EQ(tiling_notes(declared + "#declare V = N(1,2,3); #declare W = M(1,2,3);"), 1);
  EXPECT_EQ(tiling_notes(declared + "#declare V = M(1,2,3);"), 1);
  EXPECT_EQ(
      tiling_notes(declared + "isosurface { function { M(x,y,z) - 1.5 } contained_by { sphere { 0, 1 } } }"),
      1);
  EXPECT_EQ(tiling_notes("isosurface { function { y - .5 } contained_by { sphere { 0, 1 } } }"), 0);
}

TEST_F(ReadFunctions, PatternsGiveNumbers) {
  expect_value("gradient x triangle_wave scale 2", "(0.25,0,0)", 0.25);
  expect_value("checker", "(1.5,.5,.5)", 1);
  expect_value("hexagon", "(1.5,.5,.5)", 2);
  expect_value("spiral1 3", "(.3,.1,.5)", 0.560315);
  expect_value("object { sphere {0,1} }", "(0,0,0)", 1);
  expect_value("function { x }", "(1.25,0,0)", 0.25);
  expect_value("function { x } frequency 2", "(.25,0,0)", 0.5);
  expect_value("pigment_pattern { gradient x color_map { [0 rgb 0] [1 rgb <1,0,0>] } }", "(.3,.1,.5)",
               0.0891);
}

TEST_F(ReadFunctions, ImagesGiveColours) {
  write_image();
  const std::string nearest = "#declare P = function { pigment { image_map { ppm \"i.ppm\" } } }";
  expect("P(.1,.1,0)", {0, 0, 1}, nearest);
  expect("P(.9,.1,0)", {0.501961, 0.501961, 0.501961}, nearest);  // a PPM has no curve
  expect("P(1.1,.9,0)", {1, 0, 0}, nearest);
  const std::string once =
      "#declare P = function { pigment { image_map { ppm \"i.ppm\" once interpolate 2 } } }";
  expect("P(.5,.1,0)", {0.250980, 0.250980, 0.750980}, once);
  expect("P(1.5,.9,0)", {1, 1, 1, 0, 1}, once);
  const std::string sphere = "#declare P = function { pigment { image_map { ppm \"i.ppm\" map_type 1 } } }";
  expect("P(-1,.3,0)", {0, 1, 0}, sphere);
  expect("P(.3,-.3,1)", {0, 0, 1}, sphere);
  expect_value("image_pattern { ppm \"i.ppm\" }", "(.9,.1,0)", 128 / 255.0);
}

TEST_F(ReadFunctions, WarpsMoveThePoint) {
  expect_value("gradient x warp { black_hole <.5,0,0>, .5 strength 1 falloff 2 }", "(.3,.1,.1)", 0.247959);
  expect_value("gradient x warp { black_hole <.5,0,0>, .5 inverse }", "(.7,0,0)", 0.628);
  const std::string flipped = " warp { repeat .25*x flip <1,1,0> offset <0,0,.3> }";
  expect_value("gradient x" + flipped, "(.3,.1,.2)", 0.2);
  expect_value("gradient y" + flipped, "(.3,.1,.2)", 0.9);
  expect_value("gradient z" + flipped, "(.3,.1,.2)", 0.5);
  expect_value("gradient x warp { cylindrical }", "(-.3,.6,.2)", 0.406416);
  expect_value("gradient y warp { cylindrical orientation y }", "(.3,.1,.2)", 0.639445);
  expect_value("gradient z warp { cylindrical orientation x }", "(.3,.1,.2)", 0.906416);
  expect_value("gradient y warp { spherical }", "(-.3,.6,.2)", 0.827763);
  expect_value("gradient y warp { spherical dist_exp 1 }", "(.3,.1,.2)", 0.219306);
  expect_value("gradient y warp { toroidal dist_exp 1 major_radius .5 }", "(.3,.1,.2)", 0.154605);
  expect_value("gradient z warp { planar x, .25 }", "(.3,.1,.2)", 0.7);
  expect_value("gradient z scale 2 warp { planar x, .5 }", "(.3,.1,.2)", 0.85);
  expect_value("gradient x warp { repeat .4*x } warp { planar x, .5 }", "(.3,.1,.2)", 0.1);
}

TEST_F(ReadFunctions, TransformsAndSplinesGiveVectors) {
  expect("T(1,0,0)", {1, 1, 0}, "#declare T = function { transform { rotate 90*z translate x } }");
  const std::string spline = "#declare S = function { spline { linear_spline 0,<0,1,2> 1,<1,2,4> } }";
  expect("S(0.5)", {0.5, 1.5, 3}, spline);
  expect("F(0.5)", {3}, spline + "#declare F = function(t) { S(t).y * 2 }");
}

TEST_F(ReadFunctions, LinesMeetObjects) {
  const auto traced = [&](const std::string& object, const std::string& line, std::vector<double> at,
                          std::vector<double> normal) {
    const std::string before =
        "#declare O = " + object + " #declare N = 9*x; #declare H = trace(O, " + line + ", N);";
    expect("H", std::move(at), before);
    expect("N", std::move(normal), before);
  };
  traced("sphere {0,1}", "<0,0,-3>, 5*z", {0, 0, -1}, {0, 0, -1});
  traced("sphere {0,1}", "<0,0,-1>, z", {0, 0, 1}, {0, 0, 1});
  traced("sphere {0,1}", "<0,3,-3>, z", {0, 0, 0}, {0, 0, 0});
  traced("sphere {0,1 inverse}", "<0,0,-3>, z", {0, 0, -1}, {0, 0, 1});
  traced("sphere {0,1 scale <2,1,1>}", "<1,0,-3>, z", {1, 0, -0.866025}, {0.277350, 0, -0.960769});
  traced("plane {y,0}", "<0,-1,0>, y", {0, 0, 0}, {0, 1, 0});
  traced("triangle {0,x,y}", "<.2,.2,-1>, z", {.2, .2, 0}, {0, 0, -1});
  traced("smooth_triangle {0,<0,1,-1>,x,<0,0,-1>,y,<1,0,-1>}", "<.2,.2,-1>, z", {.2, .2, 0},
         {0.159488, 0.478464, -0.863502});
  traced("difference { box {-1,1} sphere {0,.8 translate -z} }", "<.2,0,-3>, z", {.2, 0, -0.225403},
         {-.25, 0, -0.968246});
  traced("sphere {0,1 clipped_by { plane {z,0 inverse} } }", "<0,0,-3>, z", {0, 0, 1}, {0, 0, 1});
  traced("cylinder {-y,y,1 open}", "<.5,3,0>, <.2,-1,0>", {1, .5, 0}, {1, 0, 0});
  traced("cone {0,1,2*y,0}", "<-3,1,0>, x", {-.5, 1, 0}, {-0.894427, 0.447214, 0});
  traced("box {-1,1}", "<0,.5,-3>, z", {0, .5, -1}, {0, 0, -1});
  // Of triangles: as near as they are.
  const auto torus = values("trace(O, <1,3,0>, -y)", "#declare O = torus {1,.25}");
  EXPECT_NEAR(torus[1], 0.25, 2e-3);
}

TEST_F(ReadFunctions, PointsAreInside) {
  const auto inside = [&](const std::string& object, const std::string& point) {
    return values("inside(O, " + point + ")", "#declare O = " + object)[0] == 1;
  };
  EXPECT_TRUE(inside("sphere {0,1}", "0"));
  EXPECT_FALSE(inside("sphere {0,1}", "2*x"));
  EXPECT_TRUE(inside("plane {y,0}", "-y"));
  EXPECT_FALSE(inside("difference { box {-1,1} sphere {0,.5} }", "0"));
  EXPECT_TRUE(inside("difference { box {-1,1} sphere {0,.5} }", ".8*x"));
  EXPECT_TRUE(inside("union { sphere {0,1} box {1,2} }", "1.5"));
  EXPECT_TRUE(inside("torus {1,.25}", "x"));
  EXPECT_FALSE(inside("torus {1,.25}", "0"));
  EXPECT_FALSE(inside("sphere {0,1 clipped_by { plane {y,0} } }", ".5*y"));
  EXPECT_FALSE(inside("isosurface { function {x*x+y*y-.2} contained_by { box {-1,1} } }", "1.1*z"));
  EXPECT_TRUE(inside("quadric {<1,1,0>,0,0,-1}", "100*z"));
}

TEST_F(ReadFunctions, ExtentsAreThoseOfTheShape) {
  const auto extents = [&](const std::string& object, std::vector<double> low, std::vector<double> high) {
    expect("min_extent(O)", std::move(low), "#declare O = " + object);
    expect("max_extent(O)", std::move(high), "#declare O = " + object);
  };
  extents("blob { threshold .5 sphere {0,1,1} sphere {x,1,1} }", {-1, -1, -1}, {2, 1, 1});
  extents("isosurface { function {x*x+y*y+z*z-.2} contained_by { box {-1,1} } }", {-1, -1, -1}, {1, 1, 1});
  extents("box {-1,1 inverse}", {-1, -1, -1}, {1, 1, 1});
  extents("difference { box {-1,1} box {0,2} }", {-1, -1, -1}, {1, 1, 1});
  extents("intersection { box {-1,1} plane {y,0} }", {-1, -1, -1}, {1, 0, 1});
  extents("cylinder {0,2*y,1 rotate 45*z}", {-2.12132, -0.70711, -1}, {0.70711, 2.12132, 1});
}

}  // namespace
}  // namespace vitrail::read_functions_test
