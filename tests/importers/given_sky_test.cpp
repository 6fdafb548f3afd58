// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/given_sky.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/spectra/rgb_to_spectrum.h"

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
