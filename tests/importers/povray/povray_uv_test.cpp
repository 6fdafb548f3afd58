// SPDX-License-Identifier: Apache-2.0
// Patterns by (u,v), beside povray's pictures: which transforms move them, and on which shapes.
#include "tests/importers/povray/povray_pictures.h"

namespace vitrail::povray_uv_test {
namespace {

class PovrayUvs : public PovrayPictures {
 protected:
  // Small squares beside each other, 8 in a row, each with what is given.
  static std::string squares(const std::vector<std::string>& modifiers) {
    std::string text =
        "#version 3.7; global_settings { assumed_gamma 1 } #default { finish { ambient 1 diffuse 0 } }\n"
        "camera { orthographic location <4, -3, -5> look_at <4, -3, 0> right 8*x up 6*y }\n"
        "#declare P = pigment { uv_mapping gradient x color_map { [0 rgb 0] [1 rgb <1, .5, .2>] } }\n"
        "#declare T = texture { uv_mapping pigment { gradient x color_map { [0 rgb 0] [1 rgb 1] } } }\n"
        "#declare S = mesh2 { vertex_vectors { 4, <0, -1, 0>, <1, -1, 0>, <1, 0, 0>, <0, 0, 0> } uv_vectors "
        "{ 4, "
        "<0, 0>, <1, 0>, <1, 1>, <0, 1> } face_indices { 2, <0, 1, 2>, <0, 2, 3> } }\n";
    for (std::size_t i = 0; i < modifiers.size(); ++i)
      text += fmt::format("object {{ S {} translate <{}, {}, 0> }}\n", modifiers[i], i % 8,
                          -static_cast<int>(i / 8));
    return text;
  }
};

// Those of the block that says `uv_mapping` and of what is in it move the pattern, those outside do not.
TEST_F(PovrayUvs, TransformsWithinTheBlock) {
  const std::string map = " color_map { [0 rgb 0] [1 rgb <.3, 1, .5>] }", gradient = "gradient x" + map;
  expect_alike(
      squares({
          "texture { pigment { uv_mapping " + gradient + " scale 2 } }",
          "texture { pigment { uv_mapping " + gradient + " translate -x*.25 scale 2 } }",
          "texture { pigment { uv_mapping " + gradient + " } scale 2 }",
          "texture { pigment { uv_mapping " + gradient + " } } scale <1, 1, 2>",
          "texture { uv_mapping pigment { " + gradient + " scale 2 } }",
          "texture { uv_mapping pigment { " + gradient + " } scale 2 }",
          "uv_mapping texture { pigment { " + gradient + " scale 2 } }",
          "uv_mapping texture { pigment { " + gradient + " } scale 2 }",
          "texture { pigment { P scale 2 } }",
          "texture { T scale 2 }",
          "texture { pigment { uv_mapping gradient y pigment_map { [0 " + gradient + " scale 2] [1 " +
              gradient + " scale 2] } } }",
          "texture { pigment { uv_mapping gradient y pigment_map { [0 " + gradient + "] [1 " + gradient +
              "] } scale 2 } }",
          "texture { pigment { gradient y pigment_map { [0 uv_mapping " + gradient + "] [1 uv_mapping " +
              gradient + "] } scale 2 } }",
          "texture { uv_mapping gradient y texture_map { [0 pigment { " + gradient + " }] [1 pigment { " +
              gradient + " }] } scale 2 }",
          "texture { uv_mapping checker texture { pigment { rgb 0 } } texture { pigment { rgb <1, .5, .5> } "
          "} scale .4 }",
          "texture { pigment { uv_mapping average pigment_map { [1 " + gradient + "] [1 rgb 0] } scale 2 } }",
          "texture { pigment { uv_mapping pigment_pattern { " + gradient + " scale 2 }" + map + " } }",
          "texture { pigment { uv_mapping function { x/2 }" + map + " } }",
          "uv_mapping pigment { brick rgb 1 rgb <.2, .3, .4> brick_size <.5, .25, .5> mortar .1 translate "
          "z*.3 }",
          "pigment { uv_mapping wood" + map + " translate <-.5, -.5, 0> scale .4 }",
      }),
      .01);
}

// By the surface's own where POV-Ray has them, else by the world's x and y.
TEST_F(PovrayUvs, Shapes) {
  const std::string begin =
      "#version 3.7; global_settings { assumed_gamma 1 } #default { finish { ambient 1 diffuse 0 } }\n"
      "camera { location <.3, .2, -4> look_at 0 angle 50 } background { rgb .1 }\n"
      "#declare P = pigment { uv_mapping gradient <1, 2, 0> color_map { [0 rgb <0, 1, .2>] [.5 rgb 0] [.5 "
      "rgb 1] "
      "[1 rgb <1, 0, .2>] } scale 2 }\n";
  std::string patch =
      "bicubic_patch { type 1 flatness .001 u_steps 4 v_steps 4 uv_vectors <.2, .1> <.9, 0> <1, 1> <0, .8> ";
  for (int i = 0; i < 16; ++i)
    patch += fmt::format("{}<{}, {}, {}>", i > 0 ? ", " : "", -1.2 + .8 * (i % 4), -1.2 + .8 * (i / 4),
                         .5 * (i % 3 - 1));
  const std::vector<std::string> shapes{
      "sphere { <.1, 0, 0>, 1.2",
      "box { <-1, -1, -1>, <1, .8, 1.2>",
      "box { <-1, -1, -1>, <1, .8, 1.2> rotate <170, 30, 0>",
      "torus { 1, .4 rotate -30*x",
      "lathe { linear_spline 4, <.2, -1>, <1, -.6>, <.5, .3>, <.9, 1>",
      "lathe { quadratic_spline 5, <.2, -1.3>, <.4, -1>, <1, -.6>, <.5, .3>, <.9, 1>",
      "lathe { cubic_spline 6, <.2, -1.3>, <.4, -1>, <1, -.6>, <.5, .3>, <.9, 1>, <.8, 1.2>",
      "lathe { bezier_spline 4, <.3, -1>, <1.2, -.6>, <.2, .3>, <.9, 1>",
      "sor { 5, <.2, -1.2>, <.8, -1>, <1, 0>, <.4, .8>, <.6, 1.2> open",
      patch,
      "mesh { triangle { <-1, -1, 0>, <1, -1, 0>, <1, 1, 0> uv_vectors <0, 0>, <1, 0>, <1, 1> }",
      "mesh { triangle { <-1, -1, 0>, <1, -1, 0>, <1, 1, 0> }",
      "cylinder { -y, y, .8",
      "disc { 0, z, 1.2",
      "superellipsoid { <.5, .5>",
      "difference { box { -1, 1 } sphere { <0, 0, -1>, .8 }",
  };
  for (const std::string& shape : shapes) {
    SCOPED_TRACE(shape);
    expect_alike(begin + shape + " pigment { P } rotate <-35, 20, 0> }", .03);
  }
}

// An image lies as a pattern does.
TEST_F(PovrayUvs, ImagesOnShapes) {
  // Of 4 × 2 pixels.
  folder_.write(
      "a.ppm",
      "P6\n4 2\n255\n\xff\x10\x10\x10\xff\x10\x10\x10\xff\xff\xff\xff\x80\x10\x10\x10\x80\x10\x10\x10\x80"
      "\x20\x20\x20");
  for (const char* shape : {"sphere { 0, 1.2", "box { -1, 1", "torus { 1, .4", "cylinder { -y, y, .8"})
    expect_alike(std::string("#version 3.7; global_settings { assumed_gamma 1 }\n"
                             "camera { location <.3, .2, -4> look_at 0 angle 50 } background { rgb .1 }\n") +
                     shape +
                     " pigment { uv_mapping image_map { ppm \"a.ppm\" } } finish { ambient 1 diffuse 0 } "
                     "rotate <-35, 20, 0> }",
                 .03);
}

}  // namespace
}  // namespace vitrail::povray_uv_test
