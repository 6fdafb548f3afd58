// SPDX-License-Identifier: Apache-2.0
// Kinds of differences that public scenes had, as povray shows them.
#include "tests/importers/povray/povray_pictures.h"

namespace vitrail::povray_public_scenes_test {
namespace {

using PovrayPublicScenes = PovrayPictures;

const std::string flat_camera = "camera { orthographic location -5*z look_at 0 right 4*x up 3*y }\n";
const std::string far_lamp = "light_source { <1000, 0, -1000> rgb 1 }\n";

// A list of colours has no places between which its filters could change.
TEST_F(PovrayPublicScenes, LayersOfListsFilter) {
  const std::string a = "rgbf <.63, .61, .69, .7>", b = "rgbf <.42, .46, .52, .95>";
  for (const std::string& list : {"checker " + a + " " + b, "hexagon " + a + " " + b + " rgb <.9, .2, .1>"})
    for (const char* below : {"rgb <.92, .5, .2>", "checker rgb <.92, .1, .1> rgb 1"})
      expect_alike("#version 3.7; global_settings { assumed_gamma 1 }\n" + flat_camera + far_lamp +
                       "plane { z, .01 texture { pigment { " + below + " } } texture { pigment { " + list +
                       " } } }\n",
                   0.03);
}

// A scene that states no version has layers as those of 3.6.
TEST_F(PovrayPublicScenes, LayersWithoutVersionFilter) {
  for (const char* gamma : {"", "global_settings { assumed_gamma 1 }\n"})
    expect_alike(gamma + flat_camera + far_lamp +
                     "plane { z, 0 texture { pigment { rgb <.9, .5, .2> } finish { ambient 0 diffuse 1 } }"
                     " texture { pigment { rgbf <.6, .6, .7, .7> } finish { ambient 0 diffuse 1 } } }\n",
                 0.03);
}

// Within the radius a spotlight is whole, though its falloff ends before.
TEST_F(PovrayPublicScenes, SpotlightsWithARadiusBeyondTheFalloff) {
  for (const char* cone : {"radius 10 falloff 3 tightness 0", "radius 20 falloff 3 tightness 10"})
    expect_alike("#version 3.7; global_settings { assumed_gamma 1 }\n" + flat_camera +
                     "light_source { -5*z rgb .9 spotlight point_at 0 " + cone +
                     " }\n"
                     "plane { -z, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n",
                 0.03);
}

// The cosine's power is below 0: towards its rim such a spotlight is up to three times as bright.
TEST_F(PovrayPublicScenes, SpotlightsThatAreBrightAtTheirRim) {
  for (const char* cone : {"radius 20 falloff 28 tightness -10", "radius 5 falloff 25 tightness -1"})
    expect_alike("#version 3.7; global_settings { assumed_gamma 1 }\n" + flat_camera +
                     "light_source { -5*z rgb .3 spotlight point_at 0 " + cone +
                     " }\n"
                     "plane { -z, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n",
                 0.03);
}

// POV-Ray multiplies three numbers: of a green lamp a red plane shows nothing. Behind a coloured pane, in a
// coloured mirror, of an image and of a pattern, too.
TEST_F(PovrayPublicScenes, ColouredLampsOnColouredThings) {
  folder_.write("map.ppm", "P6\n2 1\n255\n\310\024\074\036\334\132");
  const auto lit = [](const std::string& lamp) {
    return "light_source { <1000, 0, -1000> rgb " + lamp + " }\n";
  };
  const std::string plane = "plane { z, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n";
  const auto of = [&](const std::string& pigment) {
    return "plane { z, 0 pigment { " + pigment + " } finish { ambient 0 diffuse 1 } }\n";
  };
  const std::string
      images = of("image_map { ppm \"map.ppm\" interpolate 2 } scale 2"),
      patterns = of("gradient x color_map { [0 rgb <1, .1, 0>] [1 rgb <0, .3, .9>] }"),
      pane = "plane { z, -1 pigment { rgbf <.2, .9, .4, 1> } finish { ambient 0 diffuse 0 } }\n" + plane,
      mirror =
          "plane { z, 1 pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection <.9, .3, .1> } }\n"
          "plane { z, -20 pigment { rgb <.5, .8, .3> } finish { ambient 1 diffuse 0 } }\n";
  for (const std::string& scene :
       {lit("<1, .5, .2>") + of("rgb <.8, .4, .2>"), lit("<0, 1, 0>") + of("rgb <1, .02, 0>"),
        lit("<1, .3, .1>") + images, lit("<.2, 1, .4>") + patterns, lit("<1, .4, .1>") + pane,
        lit("<1, .4, .1>") + mirror})
    expect_alike("#version 3.7; global_settings { assumed_gamma 1 }\n" + flat_camera + scene, 0.01);
}

// Letters of rods and balls, cut out of a block with rounded edges: what is left of it after a few cuts
// intersects itself where it is rounded, and the next cut could not be made.
TEST_F(PovrayPublicScenes, LettersThatAreCutOut) {
  const auto rods = [](const std::vector<Point3d>& corners,
                       const std::vector<std::array<std::size_t, 2>>& pairs) {
    std::string text = "merge {\n";
    for (const auto& [a, b] : pairs)
      text += fmt::format("cylinder {{ <{}, {}, 0>, <{}, {}, 0>, .25 }}\n", corners[a].x, corners[a].y,
                          corners[b].x, corners[b].y);
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (corners[i].z == 0)
        text += fmt::format("sphere {{ <{}, {}, 0>, .25 }}\n", corners[i].x, corners[i].y);
    return text + "}";
  };
  const std::string
      h = rods({{.25, .25, 0}, {.25, 3.75, 0}, {2.75, .25, 0}, {2.75, 3.75, 0}, {.25, 2, 1}, {2.75, 2, 1}},
               {{0, 1}, {2, 3}, {4, 5}}),
      w = rods({{.25, 3.75, 0}, {.75, .25, 0}, {1.5, 1.75, 0}, {2.25, .25, 0}, {2.75, 3.75, 0}},
               {{0, 1}, {1, 2}, {2, 3}, {3, 4}});
  expect_alike(
      "#version 3.7; global_settings { assumed_gamma 1 }\n"
      "camera { orthographic location <-2.5, 2.5, -8> look_at <-2.5, 2.5, 0> right 8*x up 6*y }\n"
      "light_source { <1000, 1000, -1000> rgb .8 shadowless } light_source { <-1000, 100, -1000> rgb .2 "
      "shadowless }\n"
      "difference { union { box { <-5, 0, -.5>, <0, 5, .5> } cylinder { <-5, 0, 0>, <-5, 5, 0>, .5 }\n"
      "sphere { <-5, 5, 0>, .5 } cylinder { <-5, 5, 0>, <0, 5, 0>, .5 } pigment { rgb <.5, .6, .7> } }\n"
      "union { object { " +
          h +
          " translate <-4, .5, -.5> }\n"
          "object { " +
          w +
          " translate -1.5*x rotate 180*y translate <-2.5, .5, .5> }\n"
          "pigment { rgb <.8, .6, .1> } } }\n",
      0.02);
}

// filter and transmit may be more than 1 together.
TEST_F(PovrayPublicScenes, PigmentsThatLetMoreThanAllThrough) {
  for (const char* color :
       {"rgbft <0, 0, 0, 1, 1>", "rgbft <.5, .2, .1, .7, .6>", "rgbft <.7, .4, .1, .8, .3>"})
    for (const char* ior : {"1", "1.2"})
      expect_alike("#version 3.7; global_settings { assumed_gamma 1 }\n" + flat_camera +
                       "plane { z, 2 pigment { rgb <.5, .6, .4> } finish { ambient 1 diffuse 0 } }\n"
                       "box { <-1, -1, -.5>, <1, 1, .5> pigment { " +
                       color + " } finish { ambient 0 diffuse 0 } interior { ior " + ior + " } }\n",
                   0.01);
}

// POV-Ray does not ask how the faces of glass are wound: here every second one looks inward.
TEST_F(PovrayPublicScenes, GlassOfLooseFaces) {
  const std::vector<std::array<int, 3>> corners{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                                {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const std::vector<std::array<std::size_t, 4>> sides{{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                      {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::string faces;
  for (const auto& side : sides) {
    const auto corner = [&](std::size_t i) {
      const auto& [x, y, z] = corners[side[i]];
      return fmt::format("<{}, {}, {}>", x, y, z);
    };
    faces += "triangle { " + corner(0) + ", " + corner(1) + ", " + corner(2) + " }\n" + "triangle { " +
             corner(0) + ", " + corner(2) + ", " + corner(3) + " }\n";
  }
  const std::string hollow =
      "sphere { 0, 1 } sphere { 0, .8 }\n";  // whose inner wall faces inward, and stays so
  for (const std::string& of : {"union {\n" + faces, "mesh {\n" + faces, "difference {\n" + hollow})
    expect_alike("#version 3.7; global_settings { assumed_gamma 1 max_trace_level 12 }\n" + raised_camera +
                     "background { rgb <.4, .6, .9> } plane { y, -1 pigment { checker rgb .9 rgb .1 } "
                     "finish { ambient 1 diffuse 0 } }\n" +
                     of +
                     "pigment { rgbf 1 } finish { ambient 0 diffuse 0 } interior { ior 1.4 } "
                     "scale .9 rotate <20, 30, 0> translate y * .8 }\n",
                 0.04);
}

// A fade counts where light leaves the object: what is within is seen as without it, and lit less.
TEST_F(PovrayPublicScenes, InteriorsFadeWhereLightLeaves) {
  const std::string clear =
      " pigment { rgbf 1 } finish { ambient 0 diffuse 0 } interior { ior 1 fade_distance .4 ";
  const auto floor = [](double z, const char* finish) {
    return fmt::format("plane {{ z, {} pigment {{ rgb <.9, .7, .5> }} finish {{ {} }} }}\n", z, finish);
  };
  const std::string lit = "ambient 0 diffuse 1", glows = "ambient 1 diffuse 0",
                    above = "light_source { <0, 0, -1000> rgb 1 }\n";
  for (const char* fade : {"fade_power 2 } }\n", "fade_power 1 fade_color <.8, .3, .1> } }\n",
                           "fade_power 1001 fade_color <.8, .3, .1> } }\n"}) {
    const std::string pond = "plane { z, 0" + clear + fade,
                      box = "box { <-1, -1, 0>, <1, 1, .5>" + clear + fade;
    for (const std::string& scene :
         {pond + floor(.3, lit.c_str()), pond + floor(.3, glows.c_str()), box + floor(.7, glows.c_str()),
          box + "box { <-.5, -.5, .1>, <.5, .5, .3> pigment { rgb .8 } finish { " + lit + " } }\n"})
      expect_alike("#version 3.7; global_settings { assumed_gamma 1 max_trace_level 10 }\n" + flat_camera +
                       above + scene,
                   0.01);
  }
}

// Clear planes that bend nothing are no levels of max_trace_level.
TEST_F(PovrayPublicScenes, ClearPlanesAreNoLevels) {
  std::string planes;
  for (int i = 0; i < 6; ++i)
    planes +=
        fmt::format("plane {{ z, {} pigment {{ rgbf <.98, .95, 1, 1> }} finish {{ ambient 0 }} }}\n", i);
  for (const char* what : {"background { rgb <.8, .7, .6> }", "plane { z, 8 pigment { rgb .7 } }"})
    expect_alike("#version 3.7; global_settings { assumed_gamma 1 max_trace_level 3 }\n" + flat_camera +
                     far_lamp + planes + what,
                 0.02);
}

// povray shoots no photons where no object is a target, or none lets them go on: glass is then as without.
TEST_F(PovrayPublicScenes, PhotonsWithoutTargets) {
  for (const char* object : {"", "photons { target }", "photons { reflection on refraction on }"})
    expect_alike("#version 3.7; global_settings { assumed_gamma 1 photons { count 5000 } }\n" +
                     raised_camera + two_lamps +
                     "plane { y, 0 pigment { checker rgb <.8, .7, .6>, rgb <.3, .4, .2> } }\n"
                     "sphere { <-.4, .8, 1>, .8 pigment { rgbf <.9, .95, .9, .9> }"
                     " finish { reflection .3 phong 1 } interior { ior 1.2 } " +
                     object + " }",
                 0.03);
}

// A pattern without a map shows colours of its own.
TEST_F(PovrayPublicScenes, PatternsWithoutAMap) {
  for (const char* pattern :
       {"agate", "bozo", "spotted", "marble turbulence .3", "wood", "radial", "mandel 25 scale .8",
        "mandel 25 exponent 3 scale .8", "granite", "pigment_pattern { bozo }",
        "pigment_pattern { wood } color_map { [0 rgb 0] [1 rgb <1, .6, .2>] }"})
    expect_alike("#version 3.7; global_settings { assumed_gamma 1 }\n" + flat_camera +
                     "plane { z, 0 pigment { " + pattern +
                     " translate .01*z } finish { ambient 1 diffuse 0 } }\n",
                 0.03, 64);
}

// Beyond 1 colours that are encoded go on by the same curve.
TEST_F(PovrayPublicScenes, EncodedColoursAboveOne) {
  for (const char* gamma : {"1", "2.2", "srgb"})
    for (const char* lamp : {"srgb 1.2", "srgb <1.6, 1, 1.3>", "rgb 1.2"})
      expect_alike("#version 3.7; global_settings { assumed_gamma " + std::string(gamma) + " }\n" +
                       flat_camera + "light_source { <0, 0, -1000> color " + lamp +
                       " parallel point_at 0 }\n"
                       "plane { z, 0 pigment { rgb .3 } finish { ambient 0 diffuse 1 } }\n",
                   0.01);
}

// Blue lamps are chosen as often as green ones, though their luminance is a twentieth: else their noise is 2
// %.
TEST_F(PovrayPublicScenes, LampsOfAllColoursHaveTheirShareOfSamples) {
  expect_alike("#version 3.7; global_settings { assumed_gamma 1 }\n" + flat_camera +
                   "light_source { <-2, 3, -9> rgb <0, 0, 1> } light_source { <2, 3, -9> rgb <0, 1, 0> }\n"
                   "plane { z, 0 pigment { rgb .6 } finish { ambient 0 diffuse 1 } }\n",
               0.015, 128);
}

}  // namespace
}  // namespace vitrail::povray_public_scenes_test
