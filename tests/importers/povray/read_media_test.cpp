// SPDX-License-Identifier: Apache-2.0
// What POV-Ray's fog and media become.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "importers/povray/read/povray.h"
#include "scene/spectra/color.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::read_media_test {
namespace {

class ReadPovrayMedia : public ::testing::Test {
 protected:
  ImportedScene read(const std::string& text) {
    const auto path = folder_.path() / "scene.pov";
    std::ofstream(path) << "#version 3.7; global_settings { assumed_gamma 1 }\n"
                        << "camera { location <0, 1.5, 0> look_at <0, 1.5, 1> }\n"
                        << text;
    return read_povray(path);
  }
  static bool says(const ImportedScene& scene, const std::string& text) {
    for (const auto& note : scene.diagnostics)
      if (note.message.find(text) != std::string::npos) return true;
    return false;
  }

  TemporaryFolder folder_;
};

TEST_F(ReadPovrayMedia, Fog) {
  const ImportedScene fog = read("fog { distance 20 rgb <0.5, 0.25, 1> } sphere { z*5, 1 }");
  ASSERT_EQ(fog.scene.media.size(), 1u);
  ASSERT_TRUE(fog.scene.camera_medium);
  const Medium& medium = fog.scene.media[0];
  const auto& coefficients = std::get<AbsorptionScattering>(medium.coefficients);
  EXPECT_NEAR(evaluate(std::get<Spectrum>(coefficients.sigma_a), 550), 0.05, 1e-7);
  EXPECT_EQ(evaluate(std::get<Spectrum>(coefficients.sigma_s), 550), 0);
  ASSERT_TRUE(medium.emission);
  const double luminance_of_color = 0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722;
  EXPECT_NEAR(luminance(*medium.emission), luminance_of_color, 0.01);
  EXPECT_TRUE(fog.diagnostics.empty());
}

TEST_F(ReadPovrayMedia, FogHidesTheBackground) {
  const ImportedScene clear = read("background { rgb 1 } sphere { z*5, 1 }"),
                      foggy = read("background { rgb 1 } sphere { z*5, 1 } fog { distance 9 rgb .5 }"),
                      off = read("background { rgb 1 } sphere { z*5, 1 } fog { distance 0 rgb .5 }");
  EXPECT_EQ(clear.scene.area_lights.size(), foggy.scene.area_lights.size() + 1);
  EXPECT_EQ(off.scene.area_lights.size(), clear.scene.area_lights.size());
  EXPECT_FALSE(off.scene.camera_medium);
}

// The fog around the eye ends where it is as thick as it gets; with transmit 1 there is none.
TEST_F(ReadPovrayMedia, FogThatTransmitsEnds) {
  const ImportedScene fog = read("fog { distance 20 rgbt <.5, .5, .5, .25> } sphere { z*5, 1 }"),
                      plain = read("fog { distance 20 rgb .5 } sphere { z*5, 1 }"),
                      none = read("fog { distance 20 rgbt 1 } sphere { z*5, 1 }"),
                      vast = read("fog { distance 1e60 rgbt <.5, .5, .5, .25> } sphere { z*5, 1 }");
  ASSERT_EQ(fog.scene.shapes.size(), 2u);
  const Shape& side = fog.scene.shapes.front();
  EXPECT_EQ(side.interior, fog.scene.camera_medium);
  EXPECT_FALSE(side.exterior);
  for (const Point3f p : fog.scene.meshes[side.mesh.value].positions)
    EXPECT_NEAR(length(cast<double>(p) - Point3d{}), -20 * std::log(0.25), 1e-3);
  EXPECT_EQ(plain.scene.shapes.size(), 1u);
  EXPECT_TRUE(none.scene.media.empty());
  EXPECT_FALSE(none.scene.camera_medium);
  for (const Point3f p : vast.scene.meshes[vast.scene.shapes.front().mesh.value].positions)
    EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
}

TEST_F(ReadPovrayMedia, GroundFogIsAsThickAsItsLayers) {
  const ImportedScene fog = read(
      "#declare F = fog { fog_type 2 distance 10 rgb .5 fog_offset 1 fog_alt 2 }"
      "fog { F } sphere { z*5, 1 }");
  ASSERT_TRUE(fog.scene.camera_medium);
  const auto sigma = [&](std::optional<Id<Medium>> id) {
    if (!id) return 0.0;
    const auto& coefficients = std::get<AbsorptionScattering>(fog.scene.media[id->value].coefficients);
    return evaluate(std::get<Spectrum>(coefficients.sigma_a), 550);
  };
  double column = 0, last = 1;
  std::optional<Id<Medium>> below;
  for (const Shape& shape : fog.scene.shapes) {
    if (!shape.interior) continue;
    const double height = shape.object_to_world.m[1][3];
    column += (height - last) * sigma(below ? below : shape.interior);
    EXPECT_GT(sigma(shape.interior), sigma(shape.exterior));
    below = shape.exterior, last = height;
  }
  EXPECT_NEAR(last, 101, 1e-3);
  EXPECT_NEAR(column, 2.0 / 10 * std::atan(50.0), 1e-4);  // alt/distance · atan u
  // The camera is a quarter of alt above the offset.
  EXPECT_NEAR(sigma(fog.scene.camera_medium), 0.1 * (std::atan(0.3) - std::atan(0.15)) / 0.15, 1e-5);
  EXPECT_TRUE(says(fog, "ground fog"));
}

// ---- media {}

double at_550(const VolumeParameter& volume) { return evaluate(std::get<Spectrum>(volume), 550); }
const ExtinctionAlbedo& coefficients_of(const Medium& medium) {
  return std::get<ExtinctionAlbedo>(medium.coefficients);
}

constexpr const char* clear = "hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 }";

TEST_F(ReadPovrayMedia, AbsorptionAndEmission) {
  const ImportedScene read_scene =
      read(std::string("#declare M = media { absorption .25 }\nsphere { z*5, 1 ") + clear +
           " interior { media { emission .5 samples 3, 4 } media { M } } }");
  ASSERT_EQ(read_scene.scene.media.size(), 1u);
  const Medium& medium = read_scene.scene.media[0];
  EXPECT_NEAR(at_550(coefficients_of(medium).sigma_t), 0.25, 1e-6);
  EXPECT_NEAR(at_550(coefficients_of(medium).albedo), 0, 1e-9);
  EXPECT_NEAR(luminance(*medium.emission), 2, 0.01);  // e/a
  ASSERT_EQ(read_scene.scene.shapes.size(), 1u);
  const Shape& sphere = read_scene.scene.shapes[0];
  EXPECT_TRUE(sphere.interior && !sphere.exterior);
  EXPECT_TRUE(
      std::holds_alternative<InterfaceMaterial>(read_scene.scene.materials[sphere.material.value].model));
  EXPECT_FALSE(read_scene.scene.camera_medium);
}

TEST_F(ReadPovrayMedia, ScatteringIsFourTimesAsBright) {
  const ImportedScene read_scene =
      read(std::string("box { -1, 1 ") + clear +
           " interior { media { scattering { 5, .2 eccentricity .5 extinction .5 } } } translate 5*z }");
  ASSERT_EQ(read_scene.scene.media.size(), 1u);
  const Medium& medium = read_scene.scene.media[0];
  EXPECT_NEAR(at_550(coefficients_of(medium).sigma_t), 0.1, 1e-5);
  EXPECT_NEAR(at_550(coefficients_of(medium).albedo), 8, 1e-3);
  EXPECT_FLOAT_EQ(medium.g, 0.5f);
  EXPECT_FALSE(medium.emission);
}

TEST_F(ReadPovrayMedia, WithoutHollowThereAreNone) {
  const ImportedScene read_scene = read("sphere { z*5, 1 interior { media { emission .5 } } }");
  EXPECT_TRUE(read_scene.scene.media.empty());
  EXPECT_TRUE(says(read_scene, "without hollow"));
}

TEST_F(ReadPovrayMedia, DensitiesAreGrids) {
  const ImportedScene read_scene = read(
      std::string("sphere { 0, 1 ") + clear +
      " interior { media { emission .5 density { spherical color_map { [0 rgb 0] [1 rgb <1, 2, 4>] } } } }"
      " scale 2 translate <0, 0, 9> }");
  ASSERT_EQ(read_scene.scene.media.size(), 1u);
  const Medium& medium = read_scene.scene.media[0];
  ASSERT_TRUE(medium.emission_scale);
  const Grid& grid = *medium.emission_scale;
  EXPECT_EQ(grid.channels, 3);
  EXPECT_NEAR(grid.bounds.lower.z, 7, 1e-9);
  EXPECT_NEAR(grid.bounds.upper.x, 2, 1e-9);
  const auto at = [&](int i, int j, int k, int channel) {
    return static_cast<double>(
        grid.values[static_cast<std::size_t>(((k * grid.ny + j) * grid.nx + i) * 3 + channel)]);
  };
  const double near = std::sqrt(3.0) / grid.nx;  // of the middle of a cell beside the centre, to it
  EXPECT_NEAR(at(grid.nx / 2, grid.ny / 2, grid.nz / 2, 0), 0.5 * (1 - near), 1e-5);
  EXPECT_NEAR(at(grid.nx / 2, grid.ny / 2, grid.nz / 2, 2), 2 * (1 - near), 1e-5);
  EXPECT_EQ(at(0, 0, 0, 1), 0);
  EXPECT_TRUE(says(read_scene, "densities"));
}

// Corner values of povray's own picture of the file, in 255ths; x runs fastest.
TEST_F(ReadPovrayMedia, ADensityFileIsAGrid) {
  const unsigned char bytes[] = {0, 2, 0, 2, 0, 2, 0, 255, 128, 64, 200, 20, 90, 150};
  std::ofstream(folder_.path() / "a.df3", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes), sizeof bytes);
  const auto grid_of = [&](const std::string& more) {
    const ImportedScene file = read(std::string("box { 0, 1 ") + clear +
                                    " interior { media { emission 1 density { density_file df3 "
                                    "\"a.df3\" " +
                                    more + " } } } translate <-.5, 1, 4> }");
    return file.scene.media.at(0).emission_scale.value();
  };
  const Grid cells = grid_of(""), smooth = grid_of("interpolate 1");
  const auto at = [](const Grid& grid, double x, double y, double z) {
    const auto index = [](double t, int n) { return static_cast<std::size_t>(t * n); };
    const std::size_t i = index(x, grid.nx), j = index(y, grid.ny), k = index(z, grid.nz);
    return 255 *
           static_cast<double>(
               grid.values[((k * static_cast<std::size_t>(grid.ny) + j) * static_cast<std::size_t>(grid.nx) +
                            i) *
                           3]);
  };
  EXPECT_NEAR(at(cells, 0.3, 0.2, 0.25), 0, 0.01);
  EXPECT_NEAR(at(cells, 0.7, 0.2, 0.25), 255, 0.01);
  EXPECT_NEAR(at(cells, 0.7, 0.8, 0.25), 64, 0.01);
  EXPECT_NEAR(at(cells, 0.3, 0.2, 0.75), 200, 0.01);
  // povray shows 105 and 130 there, of z = 0.25; the grid has the middles of its cells.
  EXPECT_NEAR(at(smooth, 0.0625, 0.9375, 0.25), 105, 4);
  EXPECT_NEAR(at(smooth, 0.4375, 0.9375, 0.25), 130, 4);
  EXPECT_THROW(read(std::string("box { 0, 1 ") + clear +
                    " interior { media { emission 1 density { density_file "
                    "df3 \"scene.pov\" } } } }"),
               Error);
}

// povray leaves e^(−(1 − c)·d/distance) of a fade_power of 1000: 0.6703 over 2 where c is 0.8.
TEST_F(ReadPovrayMedia, InteriorsFade) {
  const auto absorption = [&](const std::string& fade, const std::string& pigment) {
    const ImportedScene found = read("box { <-1, 0, 4>, <1, 2, 6> pigment { " + pigment +
                                     " } interior { fade_distance 1 " + fade + " } }");
    const Shape& shape = found.scene.shapes.at(0);
    return shape.interior ? at_550(std::get<AbsorptionScattering>(
                                       found.scene.media.at(shape.interior->value).coefficients)
                                       .sigma_a)
                          : 0.0;
  };
  EXPECT_NEAR(absorption("fade_power 1001 fade_color rgb .8", "rgbt 1"), -std::log(0.6703) / 2, 1e-4);
  EXPECT_NEAR(absorption("fade_power 1000", "rgbf 1"), 1, 1e-5);
  // 1/(1 + d²) over 4/3, the mean way through a cube of 2
  EXPECT_NEAR(absorption("fade_power 2", "rgbt 1"), std::log(1 + 16.0 / 9) * 0.75, 1e-4);
  EXPECT_EQ(absorption("fade_power 2", "rgb 1"), 0);
  EXPECT_EQ(absorption("", "rgbt 1"), 0);
}

TEST_F(ReadPovrayMedia, WhatCannotBeShown) {
  const ImportedScene light = read(
      "light_source { y*9, rgb 1 media_interaction off }"
      "light_group { sphere { z*5, 1 no_reflection } light_source { 0, rgb 1 } global_lights off }");
  EXPECT_TRUE(says(light, "media_interaction"));
  EXPECT_TRUE(says(light, "no_reflection"));
  EXPECT_TRUE(says(light, "light_group"));
}

TEST_F(ReadPovrayMedia, ASheetThatLetsAllThroughIsNothing) {
  const auto material_of = [&](const std::string& color) {
    const ImportedScene scene =
        read("sphere { z*5, 1 hollow pigment { " + color + " } interior { media { absorption .1 } } }");
    return scene.scene.materials[scene.scene.shapes[0].material.value];
  };
  EXPECT_TRUE(std::holds_alternative<InterfaceMaterial>(material_of("rgbf 1").model));
  EXPECT_FALSE(std::holds_alternative<InterfaceMaterial>(material_of("rgbf <1, .5, 1, 1>").model));
}

TEST_F(ReadPovrayMedia, TheEyeInAContainerAndAround) {
  const ImportedScene inside = read(std::string("sphere { 0, 9 ") + clear +
                                    " interior { media { absorption .1 } } }"),
                      around = read("media { absorption .1 } sphere { z*5, 1 }"),
                      outside = read(std::string("sphere { 30*z, 9 ") + clear +
                                     " interior { media { absorption .1 } } }");
  EXPECT_TRUE(inside.scene.camera_medium);
  EXPECT_TRUE(around.scene.camera_medium);
  EXPECT_TRUE(around.scene.media[0].veils) << "it weakens no lamp";
  EXPECT_FALSE(inside.scene.media[0].veils);
  for (const std::string light : {"", "parallel point_at 0"}) {
    const ImportedScene weakens = read("media { absorption .1 } light_source { 9*y, rgb 1 " + light +
                                       " media_attenuation on } sphere { z*5, 1 }");
    EXPECT_EQ(weakens.scene.media[0].veils, !light.empty());
  }
  EXPECT_FALSE(outside.scene.camera_medium);
}

}  // namespace
}  // namespace vitrail::read_media_test
