// SPDX-License-Identifier: Apache-2.0
// Lights from Mitsuba's emitters: by definition, and back from what write_mitsuba writes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>
#include <random>

#include "images/image_files.h"
#include "importers/mitsuba/read/mitsuba.h"
#include "importers/mitsuba/write/write_mitsuba.h"
#include "scene/spectra/flat_emission.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/mitsuba/mitsuba_objects.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::mitsuba::mitsuba_emitters_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class MitsubaEmitters : public testing::Test {
 protected:
  void read(const Object& root) {
    TestBuilder test;
    test.scene.files = {(folder_ / "scene.xml").string()};
    read_all(test.builder, root);
    scene_ = test.scene;
    diagnostics_ = test.report.take();
  }
  // Nothing is reported but that.
  void expect_only(const std::string& words) {
    for (const Diagnostic& d : diagnostics_)
      if (words.empty() || d.message.find(words) == std::string::npos) ADD_FAILURE() << d.message;
  }
  void read_text(const std::string& xml) { read(load_objects_of_text(xml)); }
  void read_file(const std::string& elements) {
    diagnostics_ = read_mitsuba(folder_.write("file.xml", "<scene version='3.0.0'>" + elements + "</scene>"))
                       .diagnostics;
  }
  template <class T>
  T light(const std::string& xml) {
    read_text(xml);
    return std::get<T>(scene_.lights.at(0).model);
  }
  Scene written_and_read(const Scene& scene) {
    write_mitsuba(scene, folder_ / "scene.xml");
    read(load_objects(folder_ / "scene.xml"));
    return scene_;
  }
  static auto says(const std::string& text) { return Contains(Field(&Diagnostic::message, HasSubstr(text))); }

  TemporaryFolder folder_;
  Scene scene_;
  Diagnostics diagnostics_;
};

Transform some_transform() { return translate({3, -2.5, 0.1}) * rotate(0.7, {1, 2, 3}) * scale({2, 2, 2}); }

// Mitsuba 3.9 asks for none of weight 0, and meets those all around by chance alone.
TEST_F(MitsubaEmitters, OfWeightZeroThoseThatAreMetShine) {
  read_text(R"(<emitter type="point"><float name="sampling_weight" value="0"/></emitter>
      <emitter type="constant"><float name="sampling_weight" value="0"/></emitter>
      <emitter type="directional"><float name="sampling_weight" value="2"/></emitter>)");
  ASSERT_THAT(scene_.lights, SizeIs(2));
  EXPECT_TRUE(std::holds_alternative<InfiniteLight>(scene_.lights[0].model));
  EXPECT_TRUE(std::holds_alternative<DistantLight>(scene_.lights[1].model));
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaEmitters, WrittenLightsComeBack) {
  folder_.write("sky.exr", "x");
  folder_.write("slide.png", "x");
  Scene original = empty_scene();
  const Spectrum red = emission_from_rgb({3, 0.1, 0.2}), white = emission_from_rgb({1, 1, 1});
  ImageTexture image;
  image.filename = (folder_ / "slide.png").string();
  image.encoding = Encoding::srgb;
  const Id<Texture> slide = add_to(original.textures, Texture{image, false, "slide", {}});
  SpotLight spot{some_transform(), red, 10.5f, 33.25f, SpotLight::Falloff::linear, {}};
  ProjectionLight projector;
  projector.light_to_world = some_transform();
  projector.image = slide;
  projector.scale = ConstantSpectrum{0.3f};
  projector.fov_deg = 37.5f;
  projector.irradiance = true;
  EnvironmentLight sky;
  sky.filename = (folder_ / "sky.exr").string();
  sky.light_to_world = translate({3, -2.5, 0.1}) * rotate(0.7, {1, 2, 3});
  sky.projection = EnvironmentLight::Projection::latitude_longitude;
  sky.scale = ConstantSpectrum{0.7f};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 20; ++i)
    original.lights.push_back({DistantLight{unit(Vector3d{any(random), any(random), any(random)}), red}, {}});
  for (const LightModel& model : {LightModel{PointLight{{1.5, 0.1, -3}, red}}, LightModel{spot},
                                  LightModel{projector}, LightModel{sky}})
    original.lights.push_back({model, {}});
  spot.texture = slide;
  original.lights.push_back({spot, {}});
  projector.scale = scaled(inverse_d65(), 0.5);
  original.lights.push_back({projector, {}});
  const Scene again = written_and_read(original);
  ASSERT_EQ(again.lights.size(), original.lights.size());
  for (std::size_t i = 0; i < original.lights.size(); ++i)
    EXPECT_EQ(again.lights[i], original.lights[i]) << i;
  expect_only("");
  // Mitsuba distorts an image by the size of its transform, which says nothing of directions.
  Scene large = empty_scene();
  sky.light_to_world = some_transform();
  large.lights.push_back({sky, {}});
  const auto turned = std::get<EnvironmentLight>(written_and_read(large).lights.at(0).model);
  expect_only("");
  const Vector3d direction{0.1, 0.2, 0.3};
  EXPECT_NEAR(length(transform_vector(turned.light_to_world, direction) * 2.0 -
                     transform_vector(sky.light_to_world, direction)),
              0, 1e-6);
  // Mitsuba takes one light from all around.
  for (const Spectrum& radiance : {white, Spectrum{ConstantSpectrum{2}}}) {
    Scene around = empty_scene();
    around.lights.push_back({InfiniteLight{radiance}, {}});
    EXPECT_EQ(written_and_read(around).lights, around.lights);
  }
}

TEST_F(MitsubaEmitters, WrittenAreaLightsComeBack) {
  Scene original = square_scene({});
  folder_.write("slide.png", "x");
  ImageTexture image;
  image.filename = (folder_ / "slide.png").string();
  image.encoding = Encoding::srgb;
  const Id<Texture> slide = add_to(original.textures, Texture{image, false, "slide", {}});
  const Id<Texture> flat =
      add_to(original.textures, Texture{ProductTexture{slide, inverse_d65()}, false, "", {}});
  const Shape shape = original.shapes[0];
  original.shapes.clear();
  for (const AreaLight& light :
       {AreaLight{Spectrum{emission_from_rgb({5, 4, 3})}},
        AreaLight{Spectrum{ConstantSpectrum{2}}, 1, false, true}, AreaLight{slide, 2.5f}, AreaLight{flat}}) {
    original.shapes.push_back(shape);
    original.shapes.back().area_light = add_to(original.area_lights, light);
  }
  EXPECT_EQ(written_and_read(original).area_lights, original.area_lights);
  expect_only("directionalarea");
}

// Mitsuba gives diffuse surfaces that many times the light; a metal has it as it is given.
TEST_F(MitsubaEmitters, AScaledDirectionIsTold) {
  const std::string begin = "<emitter type='directional'><transform name='to_world'>",
                    end = "<rotate x='1' angle='120'/></transform></emitter>";
  read_file(begin + end);
  EXPECT_THAT(diagnostics_, testing::Not(says("scales a directional light")));
  read_file(begin + "<scale value='5'/>" + end);
  EXPECT_THAT(diagnostics_, says("scales a directional light by 5"));
}

// Numbers of an index may be above 1: the rgb variants take them, the spectral ones clamp them.
TEST_F(MitsubaEmitters, AnIndexAboveOneIsTold) {
  const auto metal = [&](const char* k) {
    read_file(
        fmt::format("<shape type='sphere'><bsdf type='conductor'><rgb name='eta' value='.2,.9,1'/>"
                    "<rgb name='k' value='{}'/></bsdf></shape>",
                    k));
  };
  metal(".5,.2,1");
  EXPECT_THAT(diagnostics_, testing::Not(says("above 1 as an rgb")));
  metal("3.5,2.4,1.8");
  EXPECT_THAT(diagnostics_, says("k above 1 as an rgb"));
  EXPECT_THAT(diagnostics_, testing::Not(says("eta above 1")));
}

TEST_F(MitsubaEmitters, PlacesByTransform) {
  const std::string to_world = "<transform name='to_world'><translate x='1' y='2' z='3'/></transform>";
  const auto point = light<PointLight>("<emitter type='point'>" + to_world + "</emitter>");
  EXPECT_EQ(point.position, (Point3d{1, 2, 3}));
  EXPECT_EQ(point.intensity, Spectrum{emission_from_rgb({1, 1, 1})});
  const auto distant = light<DistantLight>(
      "<emitter type='directional'><transform name='to_world'><matrix value='0 0 3 0 1 0 0 0 0 1 0 0 0 0 0 "
      "1'/>"
      "</transform></emitter>");
  EXPECT_EQ(distant.direction, (Vector3d{1, 0, 0}));
  EXPECT_THROW(
      read_text("<emitter type='point'><point name='position' x='1' y='2' z='3'/>" + to_world + "</emitter>"),
      Error);
  EXPECT_THROW(
      read_text("<emitter type='directional'><vector name='direction' x='0' y='0' z='0'/></emitter>"), Error);
}

TEST_F(MitsubaEmitters, SpotsFallOffLinearlyFromThreeQuarters) {
  const auto spot =
      light<SpotLight>("<emitter type='spot'><float name='cutoff_angle' value='40'/></emitter>");
  EXPECT_EQ(spot.falloff, SpotLight::Falloff::linear);
  EXPECT_EQ(spot.beam_deg, 30);
  EXPECT_EQ(light<SpotLight>("<emitter type='spot'/>").cutoff_deg, 20);
  EXPECT_EQ(light<SpotLight>("<emitter type='spot'><float name='beam_width' value='30'/></emitter>").beam_deg,
            20);
  EXPECT_THROW(read_text("<emitter type='spot'><float name='cutoff_angle' value='-1'/></emitter>"), Error);
  EXPECT_EQ(
      light<SpotLight>("<emitter type='spot'><rgb name='texture' value='0.5 0.5 0.5'/></emitter>").texture,
      std::nullopt);
}

TEST_F(MitsubaEmitters, ProjectorsFieldOfView) {
  const auto square = light<ProjectionLight>("<emitter type='projector'/>");  // 50 mm
  EXPECT_NEAR(square.fov_deg, 34.0221, 1e-4);                                 // Mitsuba 3.9.1's x_fov
  EXPECT_EQ(
      light<ProjectionLight>("<emitter type='projector'><float name='fov' value='30'/></emitter>").fov_deg,
      30);
  // The angle is measured along an axis of the image, here twice as wide as it is high.
  write_exr_image(folder_ / "wide.exr", black_image(4, 2, 3));
  const auto width_deg = [&](const std::string& axis) {
    return light<ProjectionLight>(
               "<emitter type='projector'><float name='fov' value='30'/><string name='fov_axis' value='" +
               axis + "'/><texture type='bitmap' name='irradiance'><string name='filename' value='" +
               (folder_ / "wide.exr").string() + "'/></texture></emitter>")
        .fov_deg;
  };
  const double half = std::tan(15 * std::numbers::pi / 180), degrees = 2 * 180 / std::numbers::pi;
  for (const char* along_width : {"x", "larger"}) EXPECT_EQ(width_deg(along_width), 30);
  for (const char* along_height : {"y", "smaller"})
    EXPECT_NEAR(width_deg(along_height), degrees * std::atan(2 * half), 1e-4);
  EXPECT_NEAR(width_deg("diagonal"), degrees * std::atan(2 / std::sqrt(5.0) * half), 1e-4);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaEmitters, ReflectNothingWithoutABsdf) {
  const Scene scene =
      read_mitsuba(
          folder_.write("lamp.xml",
                        "<scene version='3.0.0'><shape type='rectangle'><emitter type='area'/></shape>"
                        "<shape type='rectangle'/></scene>"))
          .scene;
  const auto reflectance = [&](std::size_t shape) {
    return std::get<DiffuseMaterial>(scene.materials.at(scene.shapes.at(shape).material.value).model)
        .reflectance;
  };
  EXPECT_EQ(reflectance(0), SpectrumParameter{Spectrum{ConstantSpectrum{0}}});
  EXPECT_EQ(reflectance(1), SpectrumParameter{Spectrum{ConstantSpectrum{0.5f}}});
}

// Mitsuba's map has its centre at −z... its zenith at +y: u = atan2(x, −z)/2π, v = acos(y)/π.
TEST_F(MitsubaEmitters, EnvironmentInTheScenesFrame) {
  folder_.write("sky.exr", "x");
  const auto sky =
      light<EnvironmentLight>("<emitter type='envmap'><string name='filename' value='sky.exr'/></emitter>");
  EXPECT_EQ(sky.filename, (folder_ / "sky.exr").string());
  for (const Vector3d world :
       {Vector3d{0.1, 0.2, 0.3}, Vector3d{-0.5, 0.2, -0.7}, Vector3d{0.3, -0.9, 0.1}}) {
    const Vector3d local = transform_vector(inverse(sky.light_to_world), world);
    EXPECT_DOUBLE_EQ(std::atan2(local.y, local.x), std::atan2(world.x, -world.z));
    EXPECT_DOUBLE_EQ(local.z, world.y);
  }
  EXPECT_THROW(read_text("<emitter type='envmap'><string name='filename' value='none.exr'/></emitter>"),
               Error);
  EXPECT_THROW(read_text("<emitter type='envmap'/>"), Error);
}

TEST_F(MitsubaEmitters, TheScaleOfAnEnvironmentIsSaid) {
  folder_.write("sky.exr", "x");
  const auto turned = [&](const std::string& by) {
    read_text("<emitter type='envmap'><string name='filename' value='sky.exr'/><transform name='to_world'>" +
              by + "</transform></emitter>");
    return diagnostics_;
  };
  EXPECT_THAT(turned("<rotate y='1' angle='50'/><scale x='-1' y='1' z='1'/>"), IsEmpty());
  EXPECT_THAT(turned("<rotate y='1' angle='50'/><scale value='2'/>"), says("Mitsuba distorts the image"));
}

TEST_F(MitsubaEmitters, WhatIsDroppedIsSaid) {
  read_text("<emitter type='skylight'/><emitter type='pont'/><emitter type='area'/>");
  EXPECT_THAT(scene_.lights, IsEmpty());
  ASSERT_THAT(diagnostics_, SizeIs(3));
  EXPECT_THAT(diagnostics_, says("\"envmap\""));
  EXPECT_THAT(diagnostics_, says("did you mean \"point\""));
  EXPECT_THAT(diagnostics_, says("belongs into a shape"));
  for (const Diagnostic& diagnostic : diagnostics_) EXPECT_GT(diagnostic.item.column, 0);
  read_text("<shape type='sphere'><emitter type='aree'/></shape>");
  EXPECT_THAT(scene_.area_lights, IsEmpty());
  EXPECT_THAT(diagnostics_, says("did you mean \"area\""));
  read_text("<emitter type='point'><float name='foo' value='1'/></emitter>");
  EXPECT_THAT(diagnostics_, says("foo"));
}

}  // namespace
}  // namespace vitrail::mitsuba::mitsuba_emitters_test
