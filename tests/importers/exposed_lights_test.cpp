// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/exposed_lights.h"

#include <gtest/gtest.h>

namespace vitrail::exposed_lights_test {
namespace {

TEST(ExposedLights, EveryLightIsTimesTheImagingRatio) {
  const Spectrum one = ConstantSpectrum{1}, two = ConstantSpectrum{2};
  const auto lights = [](const Spectrum& s, float scale) {
    SpotLight spot;
    spot.intensity = s;
    ProjectionLight projection;
    projection.scale = s, projection.power = 3.0f;  // what its image is normalised to
    GoniometricLight goniometric;
    goniometric.intensity = s, goniometric.power = 3.0f;
    EnvironmentLight environment;
    environment.scale = s, environment.illuminance = 3.0f;
    SkyLight sky;
    sky.sky_scale = scale, sky.sun_scale = 3 * scale;
    return std::vector<Light>{{PointLight{{}, s}, {}},
                              {spot, {}},
                              {projection, {}},
                              {goniometric, {}},
                              {DistantLight{{0, 0, 1}, s}, {}},
                              {InfiniteLight{s}, {}},
                              {environment, {}},
                              {sky, {}}};
  };
  Scene scene;
  scene.lights = lights(one, 1);
  scene.area_lights.resize(2);
  scene.area_lights[1].radiance = Id<Texture>{0};
  scene.area_lights[1].scale = 5;
  EXPECT_EQ(ExposedLights(scene).lights, scene.lights);
  EXPECT_EQ(ExposedLights(scene).area_lights, scene.area_lights);
  scene.film.imaging_ratio = 2;
  const ExposedLights exposed(scene);
  EXPECT_EQ(exposed.lights, lights(two, 2));
  EXPECT_EQ(exposed.area_lights[0].scale, 2);
  EXPECT_EQ(exposed.area_lights[1].scale, 10);
}

}  // namespace
}  // namespace vitrail::exposed_lights_test
