// SPDX-License-Identifier: Apache-2.0
// Small scenes as povray shows them, and as they are read and rendered here: the means of 8 × 8 blocks.
#include "tests/importers/povray/povray_pictures.h"

namespace vitrail::povray_pictures_test {
namespace {

// A ball on a floor in two lights, with ambient and a mirror.
const std::string ball =
    two_lamps +
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
    expect_alike(std::string(head) + "\n" + raised_camera + ball, 0.02);
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
      expect_alike(std::string(head) + "\n" + raised_camera + two_lamps + with(more), 0.03);
}

TEST_F(PovrayPictures, Highlights) {
  const auto shown = [&](const std::string& finish, const std::string& normal) {
    return linear_view + two_lamps + "plane { y, 0 pigment { rgb .5 } " + normal + " finish { ambient .1 " +
           finish + " } }\nsphere { <0, .9, 0>, .8 pigment { rgb <.9, .4, .2> } " + normal +
           " finish { ambient .1 " + finish + " } }\n";
  };
  for (const char* finish :
       {"phong .8 phong_size 20", "specular .7 roughness .03", "specular .6 roughness .2",
        "specular .8 roughness .05 metallic", "brilliance 3 phong .4 phong_size 60"})
    expect_alike(shown(finish, ""), 0.02);
  expect_alike(shown("specular .8 roughness .03", "normal { ripples .6 scale .3 }"), 0.04);
  expect_alike(shown("phong .8 phong_size 30", "normal { gradient x .4 sine_wave scale .2 }"), 0.04);
}

TEST_F(PovrayPictures, Shadows) {
  expect_alike(linear_view + ball + "light_source { <0, 6, 3> rgb .4 shadowless }", 0.02);
  expect_alike(linear_view + ball +
                   "box { <-1, 1.6, -1>, <1, 1.7, 0> no_shadow pigment { rgb .7 } finish { specular .5 } }",
               0.02);
}

// `interior_texture`: where normals look away, also in a mirror and by the order of corners. Not of a
// `triangle` by itself that is moved: POV-Ray then takes its corners in an order of its own.
TEST_F(PovrayPictures, Insides) {
  const std::string sides =
      " pigment { rgb <1, .2, .2> } finish { ambient 0 diffuse 1 } } interior_texture {"
      " pigment { rgb <.2, 1, .2> } finish { ambient 0 diffuse 1 } }";
  const std::string flat = "triangle { <-.3, -.3, 0>, <.3, -.3, 0>, <-.3, .3, 0> }";
  std::string text =
      "#version 3.7; global_settings { assumed_gamma 1 } camera { orthographic location -4*z look_at 0"
      " right 8*x up 6*y } light_source { <1, 2, -9> rgb 1 }\n";
  int place = 0;
  for (const std::string& shape :
       {std::string("sphere { 0, .4"), std::string("cone { -.4*y, .4, .4*y, .3 open rotate 40*x"),
        std::string("disc { 0, z, .4"), std::string("disc { 0, -z, .4"), std::string("box { -.4, .4"),
        std::string("polygon { 5, <-.4,-.4>, <.4,-.4>, <.4,.4>, <-.4,.4>, <-.4,-.4>"), "mesh { " + flat,
        std::string("smooth_triangle { <-.3, -.3, 0>, -z, <-.3, .3, 0>, -z, <.3, -.3, 0>, -z"),
        std::string(
            "mesh2 { vertex_vectors { 3, <-.3,-.3,0>, <.3,-.3,0>, <-.3,.3,0> } face_indices { 1, <0,1,2> }"),
        std::string("torus { .3, .1 rotate 60*x"),
        std::string("difference { box { -.4, .4 } sphere { <0, 0, -.4>, .3 }")})
    for (const char* mirrored : {"", " scale <1, 1, -1>"}) {
      text +=
          shape + mirrored +
          fmt::format(" translate <{}, {}, 0> texture {{", place % 6 * 1.3 - 3.25, place / 6 * 1.4 - 2.1) +
          sides + " }\n";
      ++place;
    }
  expect_alike(text, 0.02, 64);  // a shape of the wrong side is 2.4 %
}

// Spotlights in all directions across an area that fade with the square of the distance are a lamp, seen by
// what glows in its place alone. 16 lights a metre apart by 1/16: .002 of a metre, 1/(2π·f²) times 8.
TEST_F(PovrayPictures, LampsThatAreRectangles) {
  const std::string lamp =
      "light_source { <.5, 2, -.4> rgb <318310, 270563, 222817> spotlight radius 90 falloff 90 tightness 1"
      " point_at <.5, 1, -.4> area_light <.9375, 0, 0>, <0, 0, .9375>, 16, 16 adaptive 4 area_illumination"
      " fade_distance .002 fade_power 2 }\n";
  const std::string room =
      "plane { y, 0 pigment { rgb <.5, .6, .7> } finish { ambient 0 diffuse 1 } }\n"
      "sphere { <0, .5, 0>, .5 pigment { rgb <.8, .5, .3> } finish { ambient 0 diffuse 1 } }\n";
  const std::string glow =
      "polygon { 5, <0, 1.5, -.9>, <1, 1.5, -.9>, <1, 1.5, .1>, <0, 1.5, .1>, <0, 1.5, -.9> translate .5 * y"
      " pigment { rgb 1 } finish { ambient 0 diffuse 0 emission rgb <8, 6.8, 5.6> } no_shadow }\n";
  expect_alike(linear_view + lamp + room, 0.02, 128);
  expect_alike(linear_view + lamp + room + glow, 0.02, 128);
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
    expect_alike(linear_view + "background { rgb 1 } " + two_lamps + shape + sides, 0.02);
}

// A triangle that glows outside alone.
TEST_F(PovrayPictures, LightOfTheOutside) {
  for (const std::string corners : {"<-1,0,0>, <1,0,0>", "<1,0,0>, <-1,0,0>"})
    expect_alike(linear_view + two_lamps + "mesh { triangle { " + corners +
                     ", <0,1.5,0> } texture { pigment { rgb .2 } finish { emission .6 diffuse 1 } }"
                     " interior_texture { pigment { rgb .2 } finish { ambient 0 diffuse 1 } } }",
                 0.02);
}

TEST_F(PovrayPictures, Atmospheres) {
  const std::string walls = ball + "plane { -z, -6 pigment { rgb .6 } }\n";
  for (const char* media :
       {"media { absorption <.05, .1, .15> }", "media { emission .03 }",
        "fog { distance 8 rgb <.4, .5, .6> }", "media { scattering { 1, .05 extinction .2 } }"})
    expect_alike(linear_view + walls + media, 0.03, 96);
  for (const char* media :
       {"media { scattering { 1, .06 } }", "media { scattering { 5, .05 eccentricity .4 } }"})
    expect_alike(linear_view + walls + media, 0.08, 96);
  // What is not hollow keeps it out, from the eye as well.
  const std::string clear = " pigment { rgbt 1 } finish { ambient 0 diffuse 0 } no_shadow }\n";
  expect_alike(linear_view + walls + "fog { distance 4 rgb <.4, .5, .6> } sphere { <0, 1, -1>, .9" + clear,
               0.03);
  expect_alike(
      linear_view + walls + "fog { distance 4 rgb <.4, .5, .6> } sphere { <0, 1, -1>, .9 hollow" + clear,
      0.03);
  expect_alike(linear_view + walls +
                   "fog { distance 4 rgb <.4, .5, .6> } sphere { 0, 90 pigment { rgb 1 } no_shadow }",
               0.03);
}

TEST_F(PovrayPictures, AveragesOfPigmentsAndTextures) {
  const auto floor = [](const std::string& look) {
    return linear_view + two_lamps + "plane { y, 0 " + look + " }\nsphere { <0, .9, 0>, .8 " + look + " }\n";
  };
  const std::string two =
      "[1 checker rgb <.9, .2, .1> rgb <.1, .3, .9>] [3 gradient x color_map { [0 rgb 0] [1 rgb 1] } scale "
      "2]";
  expect_alike(floor("pigment { average pigment_map { " + two + " } } finish { ambient .2 }"), 0.02);
  expect_alike(
      floor("texture { average texture_map {"
            " [2 pigment { checker rgb <.9, .2, .1> rgb <.1, .3, .9> } finish { ambient .4 diffuse .2 }]"
            " [1 pigment { gradient x color_map { [0 rgb 0] [1 rgb 1] } } finish { ambient 0 }] } }"),
      0.02);
}

TEST_F(PovrayPictures, TexturesOfAPatternEachWithItsGlowAndLayers) {
  const std::string layers =
      "#declare Layers = texture { pigment { rgb <.2, .3, .9> } finish { ambient .5 diffuse .2 } }"
      " texture { pigment { checker rgbt <.9, .2, .1, 0> rgbt <1, 1, 1, .8> scale .3 }"
      " finish { ambient .2 diffuse .5 } }\n";
  for (const char* pattern : {"gradient x scale 3", "checker"}) {
    const std::string kind = pattern;
    const std::string dark = "pigment { rgb .3 } finish { ambient .05 diffuse .7 }";
    const std::string look =
        kind == "checker" ? "texture { checker texture { " + dark + " } texture { Layers } }"
                          : "texture { gradient x texture_map { [0 " + dark + "] [1 Layers] } scale 3 }";
    expect_alike(linear_view + two_lamps + layers + "plane { y, 0 " + look + " }\nsphere { <0, .9, 0>, .8 " +
                     look + " }",
                 0.02);
  }
}

TEST_F(PovrayPictures, Grain) {
  for (const char* finish : {"ambient .1 diffuse .6 crand .05", "ambient .1 diffuse .7 crand .15",
                             "ambient .2 diffuse .6 brilliance 2 crand .06 phong .4"})
    expect_alike(linear_view + two_lamps + "plane { y, 0 pigment { rgb <.8, .7, .5> } finish { " + finish +
                     " } }\nsphere { <0, .9, 0>, .8 pigment { gradient y } finish { " + finish + " } }\n",
                 0.025);
}

const std::string walls = ball + "plane { -z, -6 pigment { rgb .6 } }\n";

TEST_F(PovrayPictures, FogOnTheGround) {
  for (const char* fog : {"distance 4 rgb .6 fog_offset .2 fog_alt .6", "distance 2 rgb .1 fog_alt 1"})
    expect_alike(linear_view + walls + "fog { fog_type 2 " + fog + " }", 0.03);
}

// A map's colours below 0 show 0, and mixtures with them.
TEST_F(PovrayPictures, ColorsBelowZero) {
  for (const char* map :
       {"[0 rgb -.5] [.4 rgb x] [.7 rgb <.2, .5, .9>] [1 rgb 1]", "[0 rgb <1, -1, .5>] [1 rgb <-.2, 1, 1>]"})
    expect_alike(linear_view + two_lamps + "plane { z, 0 pigment { gradient x color_map { " + map +
                     " } scale 2 translate x } finish { ambient .5 } }",
                 0.02);
}

TEST_F(PovrayPictures, DoubleIlluminate) {
  const std::string behind = linear_view +
                             "light_source { <-2, 4, 4> rgb .8 } light_source { <3, 2, -4> rgb .3 }"
                             " plane { y, 0 pigment { rgb .6 } finish { ambient .1 diffuse .6 } }\n";
  for (const char* shape :
       {"polygon { 5 <-1, 0>, <1, 0>, <1, 1.5>, <-1, 1.5>, <-1, 0>", "box { <-1, .1, 0>, <1, 1.5, .1>",
        "sphere { y, .8 clipped_by { plane { z, .2 } }"})
    for (const char* pigment : {"rgb <.9, .4, .2>", "rgbf <1, 1, 1, .7>"})
      expect_alike(behind + shape + " double_illuminate pigment { " + pigment + " } finish { ambient .1 } }",
                   0.02);
}

// Whether it has an end or not, over objects and over what is around.
TEST_F(PovrayPictures, FogThatTransmitsAndFilters) {
  const std::string around =
      "sky_sphere { pigment { gradient y color_map { [0 rgb .9] [1 rgb <.2, .3, .9>] } } }\n";
  for (const char* fog : {"distance 4 rgbt <.4, .5, .6, .3>", "distance 4 rgbf <.7, .5, .2, .8>",
                          "distance 2 fog_type 2 fog_offset 2 fog_alt 1 rgbt <.4, .5, .6, .3>",
                          "distance 4 fog_type 2 fog_offset .2 fog_alt .6 rgbft <.3, .5, .2, 1, .4>"}) {
    expect_alike(linear_view + ball + around + "fog { " + fog + " }", 0.03);
    expect_alike(linear_view + walls + "fog { " + fog + " }", 0.03);
  }
  // From above, as on a landscape.
  expect_alike(
      "#version 3.7; global_settings { assumed_gamma 1 }\n"
      "camera { location <0, 9, -9> look_at <0, 0, 3> }\n" +
          ball + around + "fog { distance 1 fog_type 2 fog_alt .4 rgbt <.9, .8, .7, .25> }",
      0.03);
}

TEST_F(PovrayPictures, FogWithTurbulence) {
  for (const char* fog :
       {"distance 8 rgb <.7, .8, .9> turbulence .5", "distance 3 rgb .9 turbulence 2 octaves 3",
        "distance 4 rgb .6 fog_type 2 fog_offset .2 fog_alt .6 turbulence .8"})
    expect_alike(linear_view + walls + "fog { " + fog + " }", 0.06, 32);
  expect_alike(linear_view + walls + "fog { distance 6 rgb .9 turbulence .5 turb_depth .9 }", 0.09, 32);
}

TEST_F(PovrayPictures, PatternsOfPigments) {
  const auto shown = [&](const std::string& look) {
    return linear_view + two_lamps + "plane { y, 0 " + look + " }\nsphere { <0, .9, 0>, .8 " + look + " }\n";
  };
  const std::string rings =
      "pigment_pattern { onion color_map { [0 rgb 1] [.4 rgb .2] [.4 rgb <.9, .1, .5>] [1 rgb 0] } scale .7 "
      "} ";
  const std::string boxes = "pigment_pattern { checker rgb <.9, .2, .1>, rgb <.1, .3, .9> scale .6 } ";
  const std::string steps =
      "color_map { [.25 rgb <.9, .2, .1>] [.25 rgb <.2, .8, .3>] [.7 rgb <.1, .2, .9>] } ";
  expect_alike(shown("pigment { " + rings + steps + "scale 1.3 } finish { ambient .3 }"), 0.02);
  expect_alike(shown("pigment { " + boxes + steps + "} finish { ambient .3 }"), 0.02);
  expect_alike(shown("texture { " + rings +
                     "texture_map { [.2 pigment { rgb <.9, .8, .1> } finish { ambient .5 }]"
                     " [.8 pigment { rgb <.1, .2, .3> } finish { specular .8 roughness .05 }] } }"),
               0.02);
  expect_alike(
      shown("pigment { rgb .7 } normal { pigment_pattern { leopard color_map { [0 rgb 0] [1 rgb .6] }"
            " scale .1 } 1.5 } finish { ambient .1 specular .5 roughness .05 }"),
      0.03);
}

TEST_F(PovrayPictures, FormulasOfColors) {
  const auto channel = [](const char* name, const char* color) {
    return fmt::format("[function {{ pow(P(x,y,z).{}, 1.8) }} color_map {{ [0 rgb 0] [1 rgb {}] }}] ", name,
                       color);
  };
  expect_alike(
      linear_view + two_lamps +
          "#declare P = function { pigment { onion color_map { [0 rgb <.9, .3, .1>] [.6 rgb <.2, .8, .4>]"
          " [1 rgb .1] } scale .8 rotate x*30 } }\n"
          "plane { y, 0 pigment { average pigment_map { " +
          channel("x", "<3, 0, 0>") + channel("y", "<0, 3, 0>") + channel("z", "<0, 0, 3>") +
          "} scale 1.5 } finish { ambient .2 diffuse .7 } }\n",
      0.02);
}

TEST_F(PovrayPictures, Quilts) {
  for (const char* normal : {"quilted 1 scale .5", "quilted .6 control0 0 control1 1 scale .7 rotate y*20",
                             "quilted 1.5 control0 .5 control1 .2 translate .3"})
    expect_alike(linear_view + two_lamps + "plane { z, 0 pigment { rgb .7 } normal { " + normal +
                     " } finish { ambient .1 phong .5 phong_size 20 } }\n",
                 0.03);
}

TEST_F(PovrayPictures, BumpMaps) {
  std::string pixels = "P2\n64 64\n255\n";
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      pixels += fmt::format("{} ", std::lround(127 + 90 * std::sin(x * 0.39) * std::cos(y * 0.2)));
  folder_.write("bumps.pgm", pixels);
  for (const char* more : {"", " scale 3 rotate x*90"})
    expect_alike(linear_view + two_lamps +
                     "plane { z, 0 pigment { rgb .7 } normal { bump_map { pgm \"bumps.pgm\" bump_size 6"
                     " interpolate 2 }" +
                     more + " } finish { ambient .1 specular .4 roughness .05 } }\n",
                 0.03);
}

TEST_F(PovrayPictures, ColorsAboveOne) {
  for (const char* pigment :
       {"rgb <1.6, 1.2, .4>", "checker rgb .9 rgb 1.5", "gradient x color_map { [0 rgb 0] [1 rgb 2] }"})
    expect_alike(linear_view + "light_source { <-3, 5, -4> rgb .6 }\nplane { y, 0 pigment { " + pigment +
                     " } finish { ambient .05 diffuse .9 } }\n",
                 0.02);
}

// Without photons povray's light passes glass straight.
TEST_F(PovrayPictures, ShadowsOfClearGlass) {
  expect_alike(
      linear_view + two_lamps +
          "plane { y, 0 pigment { checker rgb <.8, .7, .6>, rgb <.3, .4, .2> } finish { ambient .15 } }\n"
          "sphere { <-.4, .8, 1>, .8 pigment { rgbt <1, 1, 1, .95> } finish { ambient 0 diffuse 0 }"
          " interior { ior 1.05 } }",
      0.03);
}

// The floor lies where two cells meet, whatever their size.
TEST_F(PovrayPictures, CheckersOfAFloor) {
  for (const char* scale : {".3", ".7", "1.1"})
    expect_alike(linear_view + two_lamps +
                     "plane { y, 0 pigment { checker rgb <.9, .8, .7>, rgb <.2, .3, .1> scale " + scale +
                     " } }",
                 0.02);
}

// Mirror and highlights are the same however clear a surface is; glass bends by its ior, mirrors by its
// finish.
TEST_F(PovrayPictures, ClearSurfacesThatShine) {
  for (const char* looks :
       {"pigment { rgbf <1, .3, .3, .8> } finish { ambient 0 phong .9 phong_size 40 }",
        "pigment { rgbt <1, 1, .3, .7> } finish { ambient .1 specular .9 roughness .02 reflection .2 }",
        "pigment { rgbt <1, 1, .9, .8> } finish { specular .9 roughness .02 reflection .3 conserve_energy }"
        " interior { ior 1.3 }",
        "pigment { rgbf <.7, .9, 1, .5> } finish { specular .9 roughness .02 reflection { 0, 1 fresnel } }"
        " interior { ior 1.5 fade_distance 1 fade_power 1001 fade_color <.5, .9, .6> }",
        "pigment { rgb <1, .8, .6> } finish { specular .9 roughness .01 reflection { .1, 1 fresnel } }"
        " interior { ior 1.5 }",
        "pigment { rgb <1, .6, .3> } finish { ambient 0 reflection { .3, .9 falloff 2 metallic } }"})
    expect_alike(linear_view + two_lamps +
                     "plane { z, 20 pigment { rgb <.2, .3, .5> } finish { ambient 1 diffuse 0 } }\n" +
                     "plane { y, 0 pigment { checker rgb <.8, .7, .6>, rgb <.3, .4, .2> scale .7 } "
                     "finish { ambient .1 } }\n"
                     "sphere { <0, .9, .5>, .9 " +
                     looks + " }",
                 0.03);
}

// So they are of a layer above others.
TEST_F(PovrayPictures, LayersThatShine) {
  for (const char* finish : {"phong .9 phong_size 20", "specular .7 roughness .03 reflection .2"})
    expect_alike(linear_view + two_lamps +
                     "plane { y, 0 pigment { rgb .5 } }\n"
                     "sphere { <0, .9, .5>, .9 texture { pigment { rgb <.2, .4, .1> } }"
                     " texture { pigment { gradient y color_map { [0 rgbt <.9, .8, .2, 1>] [1 rgbt <.9, .8, "
                     ".2, .2>] } }"
                     " finish { " +
                     finish + " } } }",
                 0.02);
}

// What comes behind a texture of layers is of the last one. A pigment moves as what it replaces did.
TEST_F(PovrayPictures, PartsBehindTextures) {
  const std::string varnished =
      "#declare T = texture { pigment { gradient y color_map { [0 rgb <.2, .4, .1>] [1 rgb .9] } } scale .5 }"
      " texture { pigment { rgbt <.9, .8, .2, .6> } finish { ambient .2 } scale 3 }\n";
  for (const char* more : {"finish { phong .9 phong_size 20 }",
                           "pigment { checker rgbt <.2, .1, .9, .4>, rgbt <.9, .1, .1, .4> }",
                           "normal { ripples .3 scale .5 }"}) {
    expect_alike(
        linear_view + two_lamps + varnished + "sphere { <0, .9, .5>, .9 texture { T } " + more + " }", 0.02,
        64);
    expect_alike(
        linear_view + two_lamps + varnished + "sphere { <0, .9, .5>, .9 texture { T " + more + " } }", 0.02,
        64);
    expect_alike(linear_view + two_lamps +
                     "sphere { <0, .9, .5>, .9 texture { pigment { rgb .7 } scale .3 } " + more + " }",
                 0.02, 64);
  }
}

TEST_F(PovrayPictures, ColoredAmbientUponPatterns) {
  const std::string floor =
      "plane { y, 0 pigment { checker rgb <.8, .7, .6>, rgb <.3, .4, .9> } finish { ambient .6 diffuse .3 ";
  expect_alike("#version 3.7; global_settings { assumed_gamma 1 ambient_light rgb <1, .5, .2> }\n" +
                   raised_camera + two_lamps + floor + "} }",
               0.02);
  expect_alike(linear_view + two_lamps + floor + "emission rgb <.1, .2, .7> } }", 0.02);
}

TEST_F(PovrayPictures, NormalsBeginAsTheDefaultOne) {
  expect_alike(linear_view + two_lamps +
                   "#default { pigment { rgb .7 } normal { onion .8 scale .4 } finish { phong .5 } }\n"
                   "plane { y, 0 normal { slope_map { [0 <0, 1>] [.5 <1, 1>] [.5 <1, -1>] [1 <0, -1>] } } }",
               0.03);
}

TEST_F(PovrayPictures, OrthographicCameras) {
  const std::string around =
      two_lamps +
      "plane { z, 1 inverse pigment { checker rgb <.9, .3, .2>, rgb <.2, .4, .9> scale .7 } }\n"
      "box { -.4, .4 rotate y*30 pigment { rgb <.2, .9, .3> } }\n";
  for (const char* view :
       {"location -6*z look_at 0", "location -6*z direction 2*z look_at 0", "location -4*z",
        "location -6*z look_at 0 right 4*x", "location -6*z look_at 0 up 2*y",
        "location <1, 2, -6> look_at 0 angle 30", "location -3*z look_at 0 translate x"})
    expect_alike(fmt::format("#version 3.7; global_settings {{ assumed_gamma 1 }}\n"
                             "camera {{ orthographic {} }}\n",
                             view) +
                     around,
                 0.03);
}

// Letters of boxes and cylinders that meet in one plane, cut out before a blue wall.
TEST_F(PovrayPictures, LettersAreCutOut) {
  expect_alike(
      "#version 3.7; global_settings { assumed_gamma 1 }\n#include \"chars.inc\"\n"
      "camera { orthographic location <5, 4, -5> look_at <5, 4, 0> right 16*x up 12*y }\n"
      "light_source { <100, 100, -1000> rgb 1 }\n"
      "difference { box { <-2, -2, .1>, <12, 10, 3> }\n"
      "  union { object { char_B translate 2*x } object { char_A translate 7*x } scale <1, 1.6, .2> }\n"
      "  pigment { rgb 1 } }\n"
      "box { <-1.9, -1.9, .101>, <11.9, 9.9, .1011> pigment { rgb <0, 0, 1> } }\n",
      0.02);
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
}  // namespace vitrail::povray_pictures_test
