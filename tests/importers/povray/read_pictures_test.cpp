// SPDX-License-Identifier: Apache-2.0
// What decides of the picture: the space of its colours, finishes, shadows, cameras. Numbers are povray's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "importers/povray/read/povray.h"
#include "scene/geometry/bounds.h"
#include "scene/records/material_traits.h"
#include "scene/shapes/deferred_mesh.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::read_pictures_test {
namespace {

class ReadPovrayPictures : public ::testing::Test {
 protected:
  ImportedScene read(const std::string& text, bool for_export = false) {
    const auto path = folder_.path() / "scene.pov";
    std::ofstream(path) << text;
    ImportOptions options;
    options.for_export = for_export;
    return read_povray(path, MeshMemory{}, options);
  }
  static bool says(const ImportedScene& scene, const std::string& text) {
    for (const auto& note : scene.diagnostics)
      if (note.message.find(text) != std::string::npos) return true;
    return false;
  }
  static double red(const SpectrumParameter& p) {
    const auto& spectrum = std::get<Spectrum>(p);
    if (const auto* constant = std::get_if<ConstantSpectrum>(&spectrum))
      return static_cast<double>(constant->value);
    return std::get<SigmoidSpectrum>(spectrum).rgb[0];
  }
  static const MaterialModel& model_of(const ImportedScene& imported, std::size_t shape = 0) {
    return imported.scene.materials.at(imported.scene.shapes.at(shape).material.value).model;
  }

  TemporaryFolder folder_;
};

const std::string ball = "sphere { 0, 1 pigment { rgb <.5,.2,.1> } finish { ambient 0 diffuse 1 } }";
const std::string gamma_1 = "#version 3.7; global_settings { assumed_gamma 1 } camera { location -4*z }\n";

// Colours stay what they are, and the film turns sums into light; writers get light.
TEST_F(ReadPovrayPictures, TheFilmHasTheGammaOfTheScene) {
  const auto expect = [&](const std::string& head, double gamma, double as_light) {
    const ImportedScene shown = read(head + ball), written = read(head + ball, true);
    EXPECT_EQ(shown.scene.film.working_gamma, gamma) << head;
    EXPECT_NEAR(red(std::get<DiffuseMaterial>(model_of(shown)).reflectance), 0.5, 1e-6) << head;
    EXPECT_FALSE(says(shown, "assumed_gamma"));
    EXPECT_EQ(written.scene.film.working_gamma, 1) << head;
    EXPECT_NEAR(red(std::get<DiffuseMaterial>(model_of(written)).reflectance), as_light, 1e-4) << head;
    EXPECT_EQ(says(written, "assumed_gamma"), gamma != 1) << head;
  };
  expect("#version 3.7; global_settings { assumed_gamma 1 }", 1, 0.5);
  expect("#version 3.7;", 1, 0.5);
  expect("#version 3.7; global_settings { assumed_gamma 2.2 }", 2.2, 0.2176);
  expect("#version 3.7; global_settings { assumed_gamma srgb }", srgb_gamma, 0.2140);
  expect("#version 3.6; global_settings { assumed_gamma 1.5 }", 1.5, 0.3536);
  expect("#version 3.6;", srgb_gamma, 0.2140);
  expect("", srgb_gamma, 0.2140);
}

TEST_F(ReadPovrayPictures, NumbersOfImages) {
  for (const char* name : {"a.ppm", "a.png"}) std::ofstream(folder_.path() / name) << "P3 1 1 255 255 0 0\n";
  const auto expect = [&](const std::string& head, const std::string& more, Encoding encoding, float gamma,
                          const std::string& kind = "png") {
    const ImportedScene imported =
        read(head + "plane { z, 0 pigment { image_map { " + kind + " \"a." + kind + "\" " + more + " } } }");
    const auto& image = std::get<ImageTexture>(imported.scene.textures.at(0).model);
    EXPECT_EQ(image.encoding, encoding) << head << more;
    if (encoding == Encoding::gamma) {
      EXPECT_FLOAT_EQ(image.gamma, gamma) << head << more;
    }
  };
  const std::string v37 = "#version 3.7; global_settings { assumed_gamma ", v36 = "#version 3.6; ";
  expect(v37 + "1 }", "", Encoding::automatic, 0);
  expect(v37 + "1 }", "gamma 1.8", Encoding::gamma, 1.8f);
  expect(v37 + "2.2 }", "", Encoding::linear, 0);
  expect(v37 + "2.2 }", "gamma 1.1", Encoding::gamma, 0.5f);
  expect(v37 + "srgb }", "", Encoding::linear, 0);
  expect(v37 + "1 }", "", Encoding::linear, 0, "ppm");
  expect(v37 + "1 }", "gamma 1.8", Encoding::gamma, 1.8f, "ppm");
  expect(v36, "", Encoding::linear, 0);
  expect(v36, "gamma 1.8", Encoding::gamma, 1.8f);
  expect(v36 + "global_settings { assumed_gamma 1 }", "", Encoding::linear, 0);
  expect(v36 + "global_settings { assumed_gamma 2.2 }", "", Encoding::linear, 0);
}

TEST_F(ReadPovrayPictures, HighlightsAreThoseOfTheFinish) {
  const std::string text =
      gamma_1 +
      "sphere { 0, 1 pigment { rgb <.5,.2,.1> } finish { diffuse .6 phong .4 phong_size 20 "
      "specular .3 roughness .01 brilliance 2 } }";
  const ImportedScene shown = read(text), written = read(text, true);
  const auto& finish = std::get<FinishMaterial>(model_of(shown));
  EXPECT_NEAR(red(finish.reflectance), 0.3, 1e-6);
  EXPECT_FLOAT_EQ(finish.phong, 0.4f);
  EXPECT_FLOAT_EQ(finish.phong_size, 20);
  EXPECT_FLOAT_EQ(finish.specular, 0.3f);
  EXPECT_FLOAT_EQ(finish.roughness, 0.01f);
  EXPECT_FLOAT_EQ(finish.brilliance, 2);
  EXPECT_EQ(finish.highlight, SpectrumParameter{ConstantSpectrum{1}});
  EXPECT_FALSE(says(shown, "phong") || says(shown, "brilliance"));
  EXPECT_TRUE(std::holds_alternative<BlendMaterial>(model_of(written)));
  EXPECT_TRUE(says(written, "phong") && says(written, "brilliance"));
}

// A mirror takes its share of all light; POV-Ray adds it to the rest, which is more than 1 here.
TEST_F(ReadPovrayPictures, AMirrorLeavesTheRestAsItIs) {
  const ImportedScene imported =
      read(gamma_1 + "sphere { 0, 1 pigment { rgb 1 } finish { diffuse .9 specular .5 reflection .4 } }");
  const auto& blend = std::get<BlendMaterial>(model_of(imported));
  const float mirror = std::get<float>(blend.amount);
  EXPECT_NEAR(mirror, 0.4, 1e-6);
  const auto& finish = std::get<FinishMaterial>(imported.scene.materials.at(blend.first.value).model);
  EXPECT_NEAR((1 - mirror) * finish.specular, 0.5, 1e-5);
  EXPECT_NEAR((1 - static_cast<double>(mirror)) * evaluate(std::get<Spectrum>(finish.reflectance), 550), 0.9,
              1e-3);
}

TEST_F(ReadPovrayPictures, ShadowsThatAreNotThere) {
  const std::string text = gamma_1 +
                           "light_source { 9, 1 shadowless } light_source { 9, 1 } sphere { 0, 1 no_shadow } "
                           "union { sphere { 0, 1 } box { 0, 1 } no_shadow } sphere { 0, 2 }";
  const ImportedScene shown = read(text), written = read(text, true);
  EXPECT_FALSE(shown.scene.lights.at(0).casts_shadows);
  EXPECT_TRUE(shown.scene.lights.at(1).casts_shadows);
  ASSERT_EQ(shown.scene.shapes.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(shown.scene.materials.at(shown.scene.shapes[i].material.value).casts_shadow, i == 3) << i;
  EXPECT_FALSE(says(shown, "shadow"));
  EXPECT_TRUE(written.scene.lights.at(0).casts_shadows);
  for (const Material& material : written.scene.materials) EXPECT_TRUE(material.casts_shadow);
  EXPECT_TRUE(says(written, "shadowless") && says(written, "no_shadow"));
}

TEST_F(ReadPovrayPictures, Cameras) {
  using enum WideCamera::Projection;
  const auto camera = [&](const std::string& kind) {
    return std::get<WideCamera>(
        read("camera { " + kind + " location 0 direction z } sphere { z*4, 1 }").scene.camera);
  };
  const auto expect = [&](const std::string& kind, WideCamera::Projection projection, double across,
                          double above, double edge_deg = 180, bool parallel = false) {
    const WideCamera found = camera(kind);
    EXPECT_EQ(found.projection, projection) << kind;
    EXPECT_NEAR(found.across, across, 1e-9) << kind;
    EXPECT_NEAR(found.above, above, 1e-9) << kind;
    EXPECT_NEAR(found.edge_deg, edge_deg, 1e-9) << kind;
    EXPECT_EQ(found.parallel, parallel) << kind;
    EXPECT_NEAR(found.camera_to_world.m[0][0], 1, 1e-12) << kind;
    EXPECT_NEAR(found.camera_to_world.m[1][1], 1, 1e-12) << kind;
  };
  expect("spherical", latitude_longitude, 180, 90);
  expect("spherical angle 120", latitude_longitude, 60, 30);
  expect("spherical angle 120 90", latitude_longitude, 60, 45);
  expect("fisheye angle 150 right 2*x", fisheye, 150, 75, 75);
  expect("ultra_wide_angle angle 150 right 2*x", ultra_wide, 75, 37.5);
  expect("panoramic right 2*x", panoramic, 2, 1);
  expect("cylinder 1 angle 100", upright_cylinder, 50, 0.5);
  expect("cylinder 2 angle 100 right 2*x", lying_cylinder, 1, 50);
  expect("cylinder 3 angle 100", upright_cylinder, 50, 0.5, 180, true);
  expect("cylinder 4 angle 100 right 2*x", lying_cylinder, 1, 50, 180, true);
  // It turns to the right whatever the hand of `right`.
  EXPECT_NEAR(camera("spherical right -x*4/3").camera_to_world.m[0][0], 1, 1e-12);
  EXPECT_NEAR(camera("spherical right -x*4/3").camera_to_world.m[1][1], -1, 1e-12);
  const ImportedScene omnimax = read("camera { omnimax } sphere { z*4, 1 }");
  EXPECT_TRUE(says(omnimax, "omnimax"));
  EXPECT_TRUE(std::holds_alternative<SphericalCamera>(
      read("camera { spherical } sphere { z*4, 1 }", true).scene.camera));
}

// Fog and atmosphere fill no object that is not hollow, and nothing at all where the eye is in one.
TEST_F(ReadPovrayPictures, WhatIsNotHollowKeepsFogOut) {
  const std::string clear = " pigment { rgbt 1 } finish { diffuse 0 ambient 0 } }";
  const auto fog = [&](const std::string& more) {
    return read(gamma_1 + "fog { distance 9 rgb .5 } " + more).scene;
  };
  const Scene solid = fog("sphere { 0, 1" + clear), hollow = fog("sphere { 0, 1 hollow" + clear),
              opaque = fog("sphere { 0, 1 pigment { rgb 1 } }"),
              within = fog("sphere { 0, 50 pigment { rgb 1 } }"),
              below = fog("union { plane { y, 9 } sphere { 0, 1 } pigment { rgb 1 } }"),
              sky = fog("plane { y, 9 hollow pigment { rgb 1 } }");
  EXPECT_TRUE(solid.shapes.at(0).exterior && !solid.shapes.at(0).interior);
  EXPECT_FALSE(hollow.shapes.at(0).exterior || opaque.shapes.at(0).exterior);
  for (const Scene* there : {&solid, &hollow, &opaque, &sky}) EXPECT_TRUE(there->camera_medium);
  EXPECT_FALSE(within.camera_medium || below.camera_medium);
  EXPECT_TRUE(solid.media.at(0).veils);
}

// povray shows 3.464 of x for the first, 4.619 for the one without look_at, which then is <0,0,1>.
TEST_F(ReadPovrayPictures, AnOrthographicViewIsAsWideAsItsAngleIsAtLookAt) {
  const auto width = [&](const std::string& camera) {
    const auto seen = std::get<OrthographicCamera>(
        read("camera { orthographic " + camera + " } sphere { 0, 1 }").scene.camera);
    return (seen.screen.x1 - seen.screen.x0) * length(transform_vector(seen.camera_to_world, {1, 0, 0}));
  };
  const double at_3 = 6 * std::tan(std::numbers::pi / 6);
  EXPECT_NEAR(width("location -3*z look_at 0 angle 60"), at_3, 1e-6);
  EXPECT_NEAR(width("angle 60 right 8*x location -3*z look_at 0"), at_3, 1e-6);
  EXPECT_NEAR(width("location -3*z angle 60"), at_3 * 4 / 3, 1e-6);
  EXPECT_NEAR(width("location -3*z look_at 0 angle 60 scale 2"), 2 * at_3, 1e-6);
  EXPECT_NEAR(width("location -3*z look_at 0 right 4*x up 3*y"), 4, 1e-6);
}

// x² − y² = 1 has no end; POV-Ray looks for it where a ray meets the ball; here it ends at the box of the
// ball.
TEST_F(ReadPovrayPictures, AShapeWithoutEndIsMadeWithinItsBounds) {
  const std::string shape = "quadric { <1,-1,0>, 0, 0, -1 ";
  const ImportedScene within = read(shape + "bounded_by { sphere { 0, 3 } } } sphere { 0, .1 }");
  Bounds3d box;
  for (const Shape& s : within.scene.shapes) {
    TriangleMesh storage;
    for (const Point3f& p : loaded(within.scene.meshes.at(s.mesh.value), storage).positions)
      extend(box, transform_point(s.object_to_world, cast<double>(p)));
  }
  EXPECT_NEAR(box.upper.x, 3, 1e-3);
  EXPECT_NEAR(box.upper.z, 3, 1e-3);
}

// 2π·318310·.002² = 8: of a square metre.
TEST_F(ReadPovrayPictures, SpotlightsAcrossAnAreaAreALamp) {
  const auto lamp = [](const std::string& part, int down) {
    return "light_source { <.5, 2, -.4> rgb <318310, 270563, 222817> spotlight radius 90 falloff 90 "
           "tightness 1"
           " point_at <.5, " +
           std::to_string(2 - down) + ", -.4> area_light <.9375, 0, 0>, <0, 0, .9375>, 16, 16 adaptive 4 " +
           part + " fade_distance .002 fade_power 2 }\n";
  };
  const std::string glow =
      "mesh2 { vertex_vectors { 4, <0, 2, -.9>, <1, 2, -.9>, <1, 2, .1>, <0, 2, .1> } face_indices { 2, <0, "
      "1, 2>, "
      "<0, 2, 3> } pigment { rgb 1 } finish { ambient 0 diffuse 0 emission rgb <8, 6.8, 5.6> } no_shadow }\n";
  const Scene unseen = read(gamma_1 + ball + lamp("area_illumination", 1)).scene,
              seen = read(gamma_1 + ball + lamp("area_illumination", 1) + glow).scene,
              both =
                  read(gamma_1 + ball + lamp("area_illumination", 1) + lamp("area_illumination", -1) + glow)
                      .scene,
              middle = read(gamma_1 + ball + lamp("", 1) + glow).scene;  // for media
  const auto light_of = [](const Scene& scene) -> const AreaLight& {
    return scene.area_lights.at(scene.shapes.at(1).area_light->value);
  };
  for (const Scene* scene : {&unseen, &seen, &both, &middle}) {
    EXPECT_TRUE(scene->lights.empty());
    ASSERT_EQ(scene->shapes.size(), 2u);
    EXPECT_TRUE(light_of(*scene).sampled);
    EXPECT_NEAR(luminance(std::get<Spectrum>(light_of(*scene).radiance)), 6.9, 0.1);
    EXPECT_EQ(light_of(*scene).two_sided, scene == &both);
    EXPECT_EQ(scene->shapes[1].opacity == FloatParameter{0.0f}, scene == &unseen);
  }
}

// As lamps of nothing are written: their front shines, and light passes.
TEST_F(ReadPovrayPictures, ClearLamps) {
  const Scene scene =
      read(gamma_1 +
           "#default { finish { ambient 0 } }\n#declare Clear = texture { pigment { rgbt 1 } finish { "
           "diffuse 0 } }\n"
           "#declare Black = texture { pigment { rgb 0 } finish { diffuse 0 } }\n"
           "sphere { 0, 1 texture { average texture_map { [1 Clear] [1 pigment { rgb 1 } finish { "
           "diffuse 0 emission 2 }] [-1 Black] } } interior_texture { Clear } }\n")
          .scene;
  ASSERT_EQ(scene.shapes.size(), 1u);
  const Shape& lamp = scene.shapes[0];
  EXPECT_EQ(lamp.opacity, FloatParameter{1.0f});
  EXPECT_TRUE(std::holds_alternative<InterfaceMaterial>(scene.materials[lamp.material.value].model));
  ASSERT_TRUE(lamp.area_light);
  EXPECT_FALSE(scene.area_lights[lamp.area_light->value].two_sided);
}

// As scenes whose emitters are hidden are written. Beside what glows and is seen, no_image drops the object.
TEST_F(ReadPovrayPictures, LampsThatTheCameraDoesNotSee) {
  const std::string
      lamp = "sphere { <3, 0, 0>, 1 pigment { rgb 1 } finish { diffuse 0 emission 2 } no_image }\n",
      seen = "sphere { <-3, 0, 0>, 1 pigment { rgb 1 } finish { diffuse 0 emission 2 } }\n",
      sky = "background { rgb 1 }\n",
      lid =
          "sphere { 0, 1000 pigment { rgb 0 } finish { diffuse 0 } hollow no_shadow "
          "no_reflection no_radiosity }\n";
  const auto shapes = [&](const std::string& more, bool hides) {
    const Scene scene = read(gamma_1 + ball + more).scene;
    EXPECT_EQ(scene.settings.hides_emitters, hides) << more;
    return scene.shapes.size();
  };
  EXPECT_EQ(shapes("", false), 1u);
  EXPECT_EQ(shapes(lamp, true), 2u);
  EXPECT_EQ(shapes(lamp + seen, false), 2u);
  EXPECT_EQ(shapes(lamp + sky, false), 2u) << "the sky's sphere";
  EXPECT_EQ(shapes(lamp + sky + lid, true), 3u);
}

// As they are written for shapes with an opacity that is an image, and for shapes that glow.
TEST_F(ReadPovrayPictures, WhatIsClearIsNoPartOfAMixture) {
  folder_.write("a.ppm", "P3\n2 1\n255\n255 255 255  0 0 0\n");
  const auto with = [&](const std::string& texture) {
    return read(
        gamma_1 +
        "mesh2 { vertex_vectors { 3, <0,0,0>, <1,0,0>, <0,1,0> } uv_vectors { 3, <0,0>, <1,0>, <0,1> }"
        " face_indices { 1, <0,1,2> } texture { " +
        texture + " } }");
  };
  const ImportedScene masked = with(
      "uv_mapping image_pattern { ppm \"a.ppm\" gamma srgb } texture_map { [0 pigment { rgbt 1 } finish { "
      "diffuse 0 }]"
      " [1 pigment { rgb .5 } finish { ambient 0 diffuse 1 }] }");
  EXPECT_TRUE(masked.diagnostics.empty());
  EXPECT_NEAR(red(std::get<DiffuseMaterial>(model_of(masked)).reflectance), 0.5, 1e-6);
  const auto* const amount = std::get_if<Id<Texture>>(&masked.scene.shapes.at(0).opacity);
  ASSERT_TRUE(amount);
  const auto& image = std::get<ImageTexture>(masked.scene.textures.at(amount->value).model);
  EXPECT_EQ(image.number, ImageNumber::luminance);
  EXPECT_EQ(image.encoding, Encoding::automatic);
  const ImportedScene glows = with(
      "average texture_map { [1 pigment { rgb .5 } finish { ambient 0 diffuse 1 }]"
      " [1 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission rgb <6, 5, 4> }]"
      " [-1 pigment { rgb 0 } finish { ambient 0 diffuse 0 }] }");
  EXPECT_TRUE(glows.diagnostics.empty());
  EXPECT_NEAR(red(std::get<DiffuseMaterial>(model_of(glows)).reflectance), 0.5, 1e-6);
  EXPECT_NEAR(luminance(std::get<Spectrum>(glows.scene.area_lights.at(0).radiance)), 5.14, 0.01);
}

// A clear layer with a mirror over an opaque one, in a body with an ior: a coat, and no glass.
TEST_F(ReadPovrayPictures, AClearLayerOverASurfaceIsItsCoat) {
  const std::string coat =
      " texture { pigment { rgbt 1 } finish { diffuse 0 reflection { 0, 1 fresnel on } } } interior { ior "
      "1.5 } }";
  const auto is_glass = [&](const std::string& texture) {
    const ImportedScene imported = read(gamma_1 + "sphere { 0, 1 " + texture);
    const std::vector<MaterialTraits> traits = traits_of(imported.scene.materials);
    return traits.at(imported.scene.shapes.at(0).material.value).transmits;
  };
  for (const char* below : {"texture { pigment { rgb .5 } }",
                            "texture { pigment { rgb .5 } finish { ambient 0 diffuse 1 reflection 0 } }"})
    EXPECT_FALSE(is_glass(below + coat)) << below;
  EXPECT_TRUE(is_glass(coat));
}

}  // namespace
}  // namespace vitrail::read_pictures_test
