// SPDX-License-Identifier: Apache-2.0
// The text that the Mitsuba writer makes of lights. What Mitsuba makes of it: mitsuba_oracle.h.
#include "importers/mitsuba/write/write_mitsuba.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <pugixml.hpp>

#include "images/image_files.h"
#include "tests/importers/mitsuba/write_mitsuba_fixture.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::write_mitsuba_lights_test {
namespace {

using testing::IsEmpty;

// As those of an OBJ are.
TEST_F(WriteMitsuba, LampsNamedAsTheirShapeOrMaterialHaveNoIdOfTheirOwn) {
  Scene scene = square_scene({});
  scene.materials[0].name = "glow";
  scene.area_lights.push_back({Spectrum{ConstantSpectrum{1}}});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  scene.shapes[0].name = "lamp";
  for (const auto& [name, id] : {std::pair("lamp", ""), std::pair("glow", ""), std::pair("other", "other")}) {
    scene.area_lights[0].name = name;
    const auto root = write(scene);
    EXPECT_STREQ(root.child("shape").child("emitter").attribute("id").value(), id) << name;
    EXPECT_STREQ(root.child("shape").attribute("id").value(), "lamp");
    EXPECT_THAT(diagnostics_, IsEmpty()) << name;
  }
}

// Its film has none.
TEST_F(WriteMitsuba, ExposureIsInTheLights) {
  Scene scene = square_scene({});
  scene.film.imaging_ratio = 2;
  scene.lights = {{PointLight{{1, 2, 3}, ConstantSpectrum{3}}, {}}};
  scene.area_lights.push_back({.radiance = ConstantSpectrum{5}, .scale = 7});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  const auto root = write(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
  EXPECT_EQ(value(root.child("emitter"), "intensity"), "6");
  EXPECT_EQ(value(root.child("shape").child("emitter"), "radiance"), "70");
  scene.lights = {{InfiniteLight{ConstantSpectrum{1}}, {}}, {InfiniteLight{ConstantSpectrum{2}}, {}}};
  EXPECT_EQ(value(write(scene).child("emitter"), "radiance"), "6");  // of both
}

TEST_F(WriteMitsuba, LightsKeepTheirNames) {
  Scene scene = square_scene({});
  scene.lights = {Light{.model = PointLight{{1, 2, 3}, ConstantSpectrum{3}}, .name = "bulb"}};
  scene.area_lights.push_back({.radiance = ConstantSpectrum{5}, .name = "panel"});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  const auto root = write(scene);
  EXPECT_STREQ(root.child("emitter").attribute("id").value(), "bulb");
  EXPECT_STREQ(root.child("shape").child("emitter").attribute("id").value(), "panel");
  scene.lights[0].name = "", scene.area_lights[0].name = "";
  EXPECT_FALSE(write(scene).child("emitter").attribute("id"));
}

TEST_F(WriteMitsuba, LightsThatMitsubaDoesNotHave) {
  Scene scene = square_scene({});
  EnvironmentLight light;
  light.filename = "/none.exr";
  light.portal = {};
  light.portal->emplace();
  GoniometricLight lamp;
  lamp.intensity = ConstantSpectrum{1};
  scene.lights = {{light, {}}, {lamp, {}}, {ProjectionLight{{}, Spectrum{ConstantSpectrum{1}}}, {}}};
  write(scene);
  EXPECT_THAT(diagnostics_, drops("portal"));
  EXPECT_THAT(diagnostics_, drops("none.exr"));
  EXPECT_THAT(diagnostics_, drops("cannot read the image"));
  EXPECT_THAT(diagnostics_, approximates("goniometric"));
  EXPECT_THAT(diagnostics_, drops("without an image"));
}

// Mitsuba's own skies have none. The image's first row is the zenith, its last one the nadir.
TEST_F(WriteMitsuba, SkiesWithAGroundAreImages) {
  Scene scene = square_scene({});
  SkyLight light;
  light.distribution = SkyDistribution{.diffuse_lx = 10000};  // the same from everywhere
  light.sun_scale = 0;
  light.ground = 0.3f;
  scene.lights = {{light, {}}};
  const auto emitter = write(scene).child("emitter");
  EXPECT_THAT(diagnostics_, approximates("without a ground"));
  ASSERT_STREQ(emitter.attribute("type").value(), "envmap");
  const Image image = read_linear_image(folder_ / value(emitter, "filename"));
  ASSERT_GT(image.values.front(), 0);
  EXPECT_NEAR(image.values.back() / image.values[2], 0.3, 1e-3);  // of blue
  light.distribution = std::nullopt;
  scene.lights = {{light, {}}};
  EXPECT_STREQ(write(scene).child("emitter").attribute("type").value(), "envmap");
  light.ground = 0;
  scene.lights = {{light, {}}};
  EXPECT_STREQ(write(scene).child("emitter").attribute("type").value(), "sunsky");
  EXPECT_THAT(diagnostics_, IsEmpty());
}

// Mitsuba's masks leave the light of a surface alone.
TEST_F(WriteMitsuba, WhatIsNotThereDoesNotShine) {
  Scene scene = square_scene({});
  scene.area_lights.push_back({ConstantSpectrum{2}});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  scene.shapes[0].opacity = 0.25f;
  const pugi::xml_node emitter = write(scene).child("shape").child("emitter");
  EXPECT_EQ(value(emitter, "radiance"), "0.5") << text_;
}

// pbrt's invisible lamps: spots that are together as bright, on the side that it shines to.
TEST_F(WriteMitsuba, LampsThatNothingMeetsAreSpots) {
  constexpr double pi = std::numbers::pi;
  Scene scene = square_scene({});
  scene.area_lights.push_back({ConstantSpectrum{2}});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  scene.shapes[0].opacity = 0.0f;
  for (const bool two_sided : {false, true}) {
    scene.area_lights[0].two_sided = two_sided;
    const pugi::xml_node root = write(scene);
    EXPECT_FALSE(root.child("shape"));
    EXPECT_EQ(value(root.child("integrator"), "hide_emitters"), "false");
    double flux = 0, weight = 0, towards = 0;
    std::size_t count = 0;
    for (const pugi::xml_node spot : root.children("emitter")) {
      EXPECT_STREQ(spot.attribute("type").value(), "spot");
      const auto angle = [&](const char* name) { return std::stod(value(spot, name)) * pi / 180; };
      const double a = angle("beam_width"), b = angle("cutoff_angle");
      flux += std::stod(value(spot, "intensity")) * 2 * pi * (1 - (std::sin(b) - std::sin(a)) / (b - a));
      weight += std::stod(value(spot, "sampling_weight"));
      std::array<double, 3> from{}, to{};
      const pugi::xml_node looks = spot.child("transform").child("lookat");
      std::sscanf(looks.attribute("origin").value(), "%lf,%lf,%lf", &from[0], &from[1], &from[2]);
      std::sscanf(looks.attribute("target").value(), "%lf,%lf,%lf", &to[0], &to[1], &to[2]);
      towards += to[2] - from[2];
      ++count;
    }
    const double area = 4;  // of the square
    EXPECT_NEAR(flux, pi * 2 * area * (two_sided ? 2 : 1), 1e-4 * flux);
    EXPECT_NEAR(weight, 1, 1e-4);
    EXPECT_NEAR(towards / static_cast<double>(count), two_sided ? 0 : 1, 1e-6);
    EXPECT_THAT(diagnostics_, approximates(fmt::format("becomes {} spot lights", count)));
  }
}

// Of a ball as bright from each side: its triangles lie ring by ring.
TEST_F(WriteMitsuba, SpotsOfABallLieAllAround) {
  Scene scene = square_scene({});
  scene.meshes[0] = {};
  scene.meshes[0].quadric = Quadric{QuadricKind::sphere};
  scene.area_lights.push_back({ConstantSpectrum{2}});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  scene.shapes[0].opacity = 0.0f;
  std::array<double, 3> sum{}, squares{};
  double count = 0;
  for (const pugi::xml_node spot : write(scene).children("emitter")) {
    std::array<double, 3> p{};
    std::sscanf(spot.child("transform").child("lookat").attribute("origin").value(), "%lf,%lf,%lf", &p[0],
                &p[1], &p[2]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k], squares[k] += p[k] * p[k];
    ++count;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(sum[k] / count, 0, 0.02) << k;
    EXPECT_NEAR(squares[k] / count, 1.0 / 3, 0.02) << k;
  }
}

}  // namespace
}  // namespace vitrail::write_mitsuba_lights_test
