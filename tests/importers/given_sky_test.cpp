// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/given_sky.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scene/daylight/photometry.h"
#include "scene/daylight/sky_model.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::given_sky_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

PerspectiveCamera camera(Point3d eye, Vector3d up) {
  PerspectiveCamera c;
  c.camera_to_world = look_at(eye, {}, up);
  return c;
}

TEST(GivenSky, UpIsTheCameras) {
  EXPECT_EQ(up_of_camera(camera({5, 3, 2}, {0, 0, 1})), "z");
  EXPECT_EQ(up_of_camera(camera({0, 5, 2}, {0, 0, 1})), "z");
  EXPECT_EQ(up_of_camera(camera({1, 2, 9}, {0, 0, 1})), "z");  // steeply down
  EXPECT_EQ(up_of_camera(camera({0, 3, 9}, {0, 1, 0})), "y");
  EXPECT_EQ(up_of_camera(camera({4, -3, 2}, {0, 1, 0})), "y");
  EXPECT_EQ(up_of_camera(camera({4, 3, 2}, {0, 0, -1})), "-z");
  EXPECT_EQ(up_of_camera(camera({0, 0, 9}, {0.1, 1, 0})), "y");  // level with no axis
  EXPECT_EQ(up_of_camera(PerspectiveCamera{}), "y");
}

ImportedScene under(const std::string& more, float radiance) {
  ImportedScene imported;
  imported.scene.camera = camera({5, 3, 2}, {0, 0, 1});
  if (radiance > 0) imported.scene.area_lights.emplace_back().radiance = Spectrum{ConstantSpectrum{radiance}};
  replace_sky(imported, parse_sky("48.86,2.35,2026-06-21T12:00+02:00" + more));
  return imported;
}

Vector3d zenith(const ImportedScene& imported) {
  return transform_vector(std::get<SkyLight>(imported.scene.lights.back().model).light_to_world, {0, 0, 1});
}

TEST(GivenSky, TakesNothingTwice) {
  const std::string place = "48.86,2.35,2026-06-21T12:00+02:00,";
  EXPECT_FLOAT_EQ(parse_sky(place + "4,albedo=0.3").light.turbidity, 4);
  for (const char* twice : {"turbidity=3,turbidity=4", "3,turbidity=4", "3,4"})
    EXPECT_THROW(parse_sky(place + twice), UsageError) << twice;
}

double lux(const std::array<double, sky_bands>& bands) {
  return photometric(to_xyz(spectrum_of_bands(bands)).y);
}

TEST(GivenSky, IsAsBrightAsItWasMeasured) {
  const std::string place = "48.86,2.35,2026-03-20T12:00+01:00,";
  for (const char* type : {"", "cie=1,", "cie=clear,"}) {
    const GivenSky sky = parse_sky(place + type + "direct=41200lx,diffuse=24300lx");
    const SkyModel model(sky.light);
    EXPECT_NEAR(lux(model.sun_irradiance(model.to_sun())), 41200, 5) << type;
    EXPECT_NEAR(lux(model.sky_irradiance()), 24300, 5) << type;
    EXPECT_TRUE(sky.light.distribution->has_value());
  }
  const SkyModel half(parse_sky(place + "direct=41200lx,diffuse=24300lx,sun=0.5,sky=2").light);
  EXPECT_NEAR(lux(half.sun_irradiance(half.to_sun())), 20600, 5);
  EXPECT_NEAR(lux(half.sky_irradiance()), 48600, 10);
  const SkyModel overcast(parse_sky(place + "cie=overcast").light);
  EXPECT_FALSE(overcast.has_sun());
  EXPECT_FALSE(parse_sky(place + "turbidity=4").light.distribution->has_value());
}

// One ground: what the clear sky takes for its albedo shines below the horizon, unless both are given.
TEST(GivenSky, TheGroundIsTheAlbedoToo) {
  const std::string place = "48.86,2.35,2026-06-21T12:00+02:00,";
  const auto albedo = [](const GivenSky& sky) { return evaluate(*sky.light.albedo, 550); };
  const GivenSky usual = parse_sky(place + "turbidity=3"), snow = parse_sky(place + "ground=0.7"),
                 both = parse_sky(place + "albedo=0.1,ground=0.7");
  EXPECT_EQ(usual.light.ground, 0);
  EXPECT_NEAR(albedo(usual), 0.2, 1e-6);
  EXPECT_EQ(snow.light.ground, 0.7f);
  EXPECT_NEAR(albedo(snow), 0.7, 1e-6);
  EXPECT_EQ(both.light.ground, 0.7f);
  EXPECT_NEAR(albedo(both), 0.1, 1e-6);
  EXPECT_EQ(parse_sky(place + "cie=1,cct=5000").light.color_temperature_k, 5000);
}

TEST(GivenSky, TakesAnHourOfAWeatherFile) {
  const test::TemporaryDirectory directory;
  std::ofstream(directory / "a.b.epw")
      << "LOCATION,Paris,-,FRA,made up,0,48.86,2.35,1.0,35\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n"
         "2019,6,21,12,60,?,20,10,50,99000,0,1400,300,500,640,110\n";
  const std::string file = (directory / "a.b.epw").string();
  const GivenSky hour = parse_sky(file + "@06-21T11:00,up=z"),
                 words = parse_sky("48.86,2.35,2019-06-21T11:30+01:00,direct=640W,diffuse=110W");
  EXPECT_EQ(hour.light, words.light);
  EXPECT_EQ(hour.up, "z");
  EXPECT_THROW(parse_sky(file + "@06-21T11:00,lux=file"), Error);  // it has none
  std::ofstream(directory / "a.b.epw", std::ios::app)
      << "2019,6,21,14,60,?,20,10,50,99000,0,1400,300,500,640,110,90000,60000,30000,9999\n";
  const SkyModel own(parse_sky(file + "@06-21T13:00,lux=file").light);
  EXPECT_NEAR(lux(own.sun_irradiance(own.to_sun())), 60000, 6);
  EXPECT_NEAR(lux(own.sky_irradiance()), 30000, 3);
  EXPECT_THROW(parse_sky(file + "@06-21T12:00"), Error);
  EXPECT_THROW(parse_sky(file + "@13-21T12:00"), UsageError);
}

TEST(GivenSky, RefusesWhatItCannotMean) {
  const std::string place = "48.86,2.35,2026-03-20T12:00+01:00,";
  for (const char* words :
       {"cie=0", "cie=16", "cie=1.5", "cie=cloudy", "direct=640", "direct=640W", "diffuse=-1W",
        "direct=640W,diffuse=100lx", "diffuse=nanW", "diffuse=1e9lx", "ground=1.1", "lux=file", "lux=1",
        "cct=5000", "cie=1,cct=3999", "cie=1,cct=25001"})
    EXPECT_THROW(parse_sky(place + words), UsageError) << words;
}

TEST(GivenSky, StandsAsTheCameraDoesUnlessToldOtherwise) {
  const ImportedScene by_camera = under("", 0);
  EXPECT_EQ(zenith(by_camera), (Vector3d{0, 0, 1}));
  ASSERT_EQ(by_camera.diagnostics.size(), 1u);
  EXPECT_THAT(by_camera.diagnostics[0].message, HasSubstr("up=z by the camera"));
  const ImportedScene told = under(",up=y", 0);
  EXPECT_EQ(zenith(told), (Vector3d{0, 1, 0}));
  EXPECT_THAT(told.diagnostics, IsEmpty());
}

// 1 in all of the spectrum is 73 000 cd/m²; a luminaire has some 5000.
TEST(GivenSky, LampsThatOutshineItAreTold) {
  const ImportedScene bright = under(",up=z", 17);
  ASSERT_EQ(bright.diagnostics.size(), 1u);
  EXPECT_THAT(bright.diagnostics[0].message, HasSubstr("the brightest has 1.2e+06 cd/m2"));
  EXPECT_THAT(under(",up=z", 0.07f).diagnostics, IsEmpty());
}

}  // namespace
}  // namespace vitrail::given_sky_test
