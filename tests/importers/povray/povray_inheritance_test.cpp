// SPDX-License-Identifier: Apache-2.0
// What objects take from what is around them, when that is fixed, and what stands where a file says nothing:
// as povray shows it. All shapes glow, so a picture has the colours alone.
#include "tests/importers/povray/povray_pictures.h"

namespace vitrail::povray_inheritance_test {
namespace {

const std::string view =
    "#version 3.7; global_settings { assumed_gamma 1 }\n"
    "camera { orthographic location -15*z look_at 0 right 16*x up 12*y }\n";
// `E` glows, `U` has no texture.
const std::string parts =
    view +
    "#declare E = finish { ambient 1 diffuse 0 };\n"
    "#declare White = texture { pigment { rgb 1 } finish { E } }\n"
    "#declare U = union { box { <-5, 0, 0>, <-1, 5, 1> } box { <1, 0, 0>, <5, 5, 1> } }\n";
const std::string red = "#default { pigment { rgb <1, 0, 0> } finish { E } }\n",
                  green = "#default { pigment { rgb <0, 1, 0> } finish { E } }\n";

class PovrayInheritance : public PovrayPictures {
 protected:
  void expect_colors(const std::string& text) {
    SCOPED_TRACE(text);
    expect_alike(text, 0.03);
  }
};

TEST_F(PovrayInheritance, DeclaredUnionsHaveTheTextureAroundThem) {
  for (const char* scene : {
           "union { object { U } texture { White } }",
           "union { U texture { White } }",
           "union { union { object { U } } pigment { rgb <.2, .4, .6> } finish { E } }",
           "union { object { U } object { U translate -6*y texture { White } } "
           "texture { pigment { rgb <1, .5, 0> } finish { E } } }",
           "union { object { U } texture { pigment { checker rgb 1 rgb <.2, .3, .8> } finish { E } } }",
           "union { object { U } pigment { gradient y scale 5 } finish { E } rotate 30*z }",
           "#declare V = union { object { U } box { <-1, -5, 0>, <1, -2, 1> texture { White } } }\n"
           "union { object { V scale .9 } texture { pigment { rgb <.1, .6, .2> } finish { E } } }",
           "merge { object { U } texture { White } }",
           "difference { object { U } box { <-8, 2, -1>, <8, 3, 2> pigment { rgb <1, 0, 0> } } texture { "
           "White } }",
           "intersection { object { U } sphere { 0, 4.5 } texture { White } }",
           "#declare D = difference { box { -3, 3 } cylinder { -4*z, 4*z, 2 } }\n"
           "union { object { D } object { D translate 4*x } texture { White } }",
           "union { object { U clipped_by { plane { y, 3 } } } texture { White } }",
           "light_group { object { U } } union { object { U translate -5*y } texture { White } }",
       })
    expect_colors(parts + scene);
}

TEST_F(PovrayInheritance, PartsOfATextureTakeTheRestWhereTheyStand) {
  for (const char* scene : {
           "union { object { U } finish { ambient .5 } }",
           "#declare W = union { object { U } box { <-1, -5, 0>, <1, -2, 1> finish { ambient .5 } } }\n"
           "union { object { W } pigment { rgb <0, 0, 1> } }",
           "#declare W = union { object { U } box { <-1, -5, 0>, <1, -2, 1> pigment { rgb <0, 1, 0> } } "
           "pigment { rgb <0, 0, 1> } }\nobject { W finish { ambient .5 } }",
           "#declare B = box { -3, 3 pigment { rgb <0, 1, 0> } }\n"
           "object { B texture { pigment { rgbt <0, 0, 1, .5> } finish { E } } }",
       })
    expect_colors(parts + red + scene);
}

TEST_F(PovrayInheritance, DefaultsAreThoseWhereAnObjectIsWhole) {
  const std::string box = "box { <-5, -5, 0>, <5, -2, 1> }\n";
  for (const std::string& scene : {
           red + "object { U } " + green + box,
           red + box + green + "object { U }",
           red + "#declare B = object { U }\n" + green + "object { B } " + box,
           red + "union { object { U }\n" + green + box + "}",
           red + "#declare T = texture { finish { E } }\n" + green + "object { U texture { T } } " + box,
           red +
               "#declare P = union { object { U } box { <-1, -5, 0>, <1, -2, 1> finish { ambient .5 } } }\n" +
               green + "object { P }",
           red + "light_source { 0 rgb 1 looks_like { sphere { 0, 3 } } }\n" + green + box,
           red + "difference { object { U } box { <-8, 2, -1>, <8, 3, 2> } }\n" + green + box,
           "#default { finish { E } } object { U pigment { rgb <0, 0, 1> } }\n"
           "#default { finish { ambient .3 } }" +
               box,
       })
    expect_colors(parts + scene);
}

// Lists that end before their pattern has all it shows.
TEST_F(PovrayInheritance, ListsOfBlocksEndWithThePatternsOwn) {
  const std::string whole = "finish { ambient 1 diffuse 0 } rotate <-50, 20, 0> }\n";
  for (const char* pattern :
       {"checker", "brick", "hexagon", "square", "triangular", "cubic", "object { sphere { -4*z, 2 } }",
        "checker rgb <.3, .2, .7>", "brick rgb <.3, .2, .7>", "hexagon rgb <.3, .2, .7> rgb .5",
        "square rgb <.3, .2, .7> rgb .5", "triangular rgb <.3, .2, .7> rgb .5 rgb .9 rgb .1",
        "cubic rgb <.3, .2, .7> rgb .5 rgb .9", "object { sphere { -4*z, 2 } rgb .2 }",
        "checker pigment { rgb <.3, .2, .7> }", "hexagon pigment { rgb 1 } pigment { gradient x }",
        "square pigment { rgb 1 }", "object { sphere { -4*z, 2 } pigment { rgb .2 } }"})
    expect_colors(view + "#default { pigment { rgb <.1, .3, .2> } }\nbox { -3.9, 3.7 pigment { " + pattern +
                  " } " + whole);
  for (const char* pattern : {"checker", "checker texture { W }", "hexagon texture { W }",
                              "square texture { W } texture { pigment { rgb <1, 0, 0> } }"})
    expect_colors(parts + green + "#declare W = White\nbox { -3.9, 3.7 texture { " + pattern +
                  " } rotate <-50, 20, 0> }");
}

TEST_F(PovrayInheritance, LastDeclarationsOfIncludes) {
  folder_.write("e.inc",
                "#macro M() texture { pigment { rgb <1, .5, 0> } finish { E } } #end\n#declare T = M()");
  folder_.write("f.inc", "#declare S = texture { pigment { rgb <0, .5, 1> } finish { E } }");
  expect_colors(parts +
                "#include \"e.inc\"\n#include \"f.inc\"\nobject { U texture { T } }\n"
                "object { U translate -6*y texture { S } }");
}

TEST_F(PovrayInheritance, UvVectorsWithoutIndices) {
  folder_.write("a.ppm", "P3\n2 2\n255\n255 0 0  0 255 0  0 0 255  255 255 0\n");
  const std::string mesh =
      "mesh2 { vertex_vectors { 4, <-5, -5, 0>, <5, -5, 0>, <5, 5, 0>, <-5, 5, 0> } uv_vectors { 4, <0, 0>, "
      "<1, 0>, "
      "<1, 1>, <0, 1> } face_indices { 2, <0, 1, 2>, <0, 2, 3> } ";
  const std::string map = "image_map { ppm \"a.ppm\" }";
  expect_colors(parts + mesh + "uv_mapping pigment { " + map + " } finish { E } }");
  expect_colors(parts + mesh + "texture { uv_mapping pigment { " + map + " } finish { E } } }");
  expect_colors(parts + mesh + "pigment { uv_mapping " + map + " } finish { E } }");
}

// Transformations move what was said of a lamp by then: a `point_at` behind them is where it says.
TEST_F(PovrayInheritance, LampsThatAreMoved) {
  const std::string floor =
      "plane { y, 0 pigment { rgb .8 } finish { ambient 0 diffuse .9 } }\n"
      "sphere { <0, .7, 0>, .7 pigment { rgb <.9, .5, .2> } finish { ambient 0 diffuse .9 } }\n";
  for (const char* lamp :
       {"0*x rgb 1 spotlight translate <4, 8, -6> point_at <0, 0, 0> radius 5 falloff 12 tightness 10",
        "0*x rgb 1 spotlight point_at <-4, -8, 6> translate <4, 8, -6> radius 5 falloff 12",
        "<0, 6, 0> rgb 1 spotlight rotate 30*z point_at <0, .7, 0> radius 10 falloff 15 rotate 20*x",
        "<0, 6, 0> rgb 1 rotate 90*y area_light 2*x, .1*z, 5, 5 area_illumination",
        "0*x rgb 1 translate <2, 5, -4> looks_like { sphere { 0, .5 pigment { rgb .9 } finish { ambient 1 } "
        "} "
        "}"})
    expect_alike(linear_view + floor + "light_source { " + lamp + " }", 0.03);
}

// povray warns and goes on, between statements.
TEST_F(PovrayInheritance, DirectivesWithoutTheirSign) {
  folder_.write("r.inc", "#declare R = 3;\n");
  expect_colors(view +
                "include \"r.inc\"\ndeclare C = rgb <1, .5, 0>;\ndefault { finish { ambient 1 diffuse 0 } }\n"
                "max_trace_level 4\n#max_trace_level 4\nversion 3.7\nsphere { 0, R pigment { C } }");
}

}  // namespace
}  // namespace vitrail::povray_inheritance_test
