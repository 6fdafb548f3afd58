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

}  // namespace
}  // namespace vitrail::povray_public_scenes_test
