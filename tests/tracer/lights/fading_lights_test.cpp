// SPDX-License-Identifier: Apache-2.0
// Lamps that weaken as POV-Ray's: what each sends, and that of many one is chosen by what it sends.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scene/geometry/portable_math.h"
#include "scene/models/fading.h"
#include "tests/tracer/lights/light_fixtures.h"
#include "tracer/lights/point_emitter.h"

namespace vitrail::test::fading_lights_test {
namespace {

LightScene scene_of(const std::vector<Light>& lights, float half = 10) {
  LightScene scene;
  scene.lights = lights;
  scene.bounds = {{-half, -half, -half}, {half, half, half}};
  return scene;
}

Light lamp(Point3d position, float intensity, std::optional<Fading> fading) {
  return {PointLight{position, ConstantSpectrum{intensity}, fading}, {}};
}

LightSampler sampler_of(const LightScene& scene) { return make_light_sampler(scene, ImageSource{}); }

TEST(FadingLights, OneAtAnyDistance) {
  for (const double d : {1e-3, 1.0, 37.0, 1e6})
    for (const Fading fading :
         {Fading{}, Fading{3, 0}, Fading{0, 2}, Fading{3, 1}, Fading{3, 2}, Fading{3, 4}}) {
      const std::vector<Light> lights{lamp({0, 0, d}, 2, fading)};
      const LightScene scene = scene_of(lights);
      const auto sample =
          sample_light(sampler_of(scene), {0, 0, 0}, {0.5f, 0.5f, 0.5f, 0.5f}, some_wavelengths());
      ASSERT_TRUE(sample) << d << " " << fading.fade_power;
      const double expected = fading.fade_distance > 0 && fading.fade_power > 0
                                  ? 4 / (1 + std::pow(d / static_cast<double>(fading.fade_distance),
                                                      static_cast<double>(fading.fade_power)))
                                  : 2;
      EXPECT_NEAR(static_cast<double>(sample->radiance.v[0]) / sample->pdf, expected, 1e-5 * expected);
      EXPECT_EQ(sample->pdf, 1);
    }
}

// Chosen in proportion to what it sends: lamps far and near without fall-off alike.
TEST(FadingLights, ChosenByWhatTheySend) {
  std::vector<Light> lights;
  for (int i = 0; i < 8; ++i)
    lights.push_back(lamp({std::pow(10.0, i - 2), 1, 0}, static_cast<float>(1 + i), Fading{}));
  const LightScene scene = scene_of(lights);
  const LightSampler sampler = sampler_of(scene);
  for (const Point3d p : {Point3d{0, 0, 0}, Point3d{-9, 3, 2}, Point3d{0.5, 0.999, 0}})
    for (std::uint32_t i = 0; i < 8; ++i)
      EXPECT_NEAR(sampler.tree.probability(p, i), (1 + i) / 36.0, 0.01) << i;
}

// Of the tree's weights, what one that fades by squares sends at 1, and far beyond its distance.
TEST(FadingLights, BesideAPhysicalLamp) {
  const std::vector<Light> lights{lamp({0, 0, 0}, 1, Fading{2, 2}), lamp({0, 0, 0}, 1, std::nullopt)};
  const LightScene scene = scene_of(lights, 1000);
  const LightSampler sampler = sampler_of(scene);
  for (const double d : {0.25, 1.0, 2.0, 20.0, 900.0}) {
    const double bound = 2 * 4 / std::max(d * d, 4.0), physical = 1 / (d * d);
    EXPECT_NEAR(sampler.tree.probability({d, 0, 0}, 0), bound / (bound + physical), 0.01) << d;
    EXPECT_GE(bound * 1.0001, weakened(Fading{2, 2}, d)) << d;
  }
}

// Hundreds of all kinds, in one tree: the mean is their sum, and its scatter is that of their cosines alone.
TEST(FadingLights, Many) {
  Random random(7);
  std::vector<Light> lights;
  for (int i = 0; i < 300; ++i) {
    const Point3d at = random.point(-9, 9);
    const auto intensity = static_cast<float>(random.between(0.5, 1.5));
    const std::optional<Fading> kinds[]{Fading{}, Fading{4, 2}, Fading{5, 1}, std::nullopt};
    lights.push_back(lamp(at, intensity, kinds[i % 4]));
  }
  const LightScene scene = scene_of(lights);
  const LightSampler sampler = sampler_of(scene);
  const Point3d p{0, 0, 12};
  double expected = 0;
  for (const Light& light : lights) {
    const auto& point = std::get<PointLight>(light.model);
    const double d = length(point.position - p);
    const auto intensity = static_cast<double>(std::get<ConstantSpectrum>(point.intensity).value);
    expected += intensity * (point.fading ? weakened(*point.fading, d) : 1 / (d * d));
  }
  constexpr int n = 200000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const auto sample = sample_light(sampler, p, random.four(), some_wavelengths());
    ASSERT_TRUE(sample);
    const double x = static_cast<double>(sample->radiance.v[0]) / sample->pdf;
    sum += x, squares += x * x;
  }
  const double mean = sum / n, deviation = std::sqrt(squares / n - mean * mean);
  EXPECT_NEAR(mean, expected, 4.5 * deviation / std::sqrt(n));
  EXPECT_LT(deviation, 1.5 * expected);
}

// cos^tightness within the cone, and no fall-off; powers below 0 up to where they leave the floats.
TEST(FadingLights, TightSpot) {
  for (const float tightness : {10.0f, -1.0f, -10.0f, -1000.0f}) {
    SpotLight spot;
    spot.light_to_world = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
    spot.intensity = ConstantSpectrum{1};
    spot.beam_deg = spot.cutoff_deg = 60;
    spot.fading = Fading{};
    spot.tightness = tightness;
    const std::vector<Light> lights{{spot, {}}};
    const LightScene scene = scene_of(lights);
    const LightSampler sampler = sampler_of(scene);
    for (const double degrees : {0.0, 20.0, 50.0}) {
      const double x = 5 * std::tan(degrees * pi / 180);
      const double expected = std::pow(std::cos(degrees * pi / 180), tightness);
      const auto sample = sample_light(sampler, {x, 0, 0}, {0.5f, 0.5f, 0.5f, 0.5f}, some_wavelengths());
      ASSERT_TRUE(sample) << tightness << " " << degrees;
      const double arrives = static_cast<double>(sample->radiance.v[0]) / sample->pdf;
      if (expected < 1e36) {
        EXPECT_NEAR(arrives / expected, 1, 2e-5) << tightness;
      } else {
        EXPECT_EQ(arrives, 0);
      }
    }
    const PointEmitter emitter = make_emitter(spot, nullptr, {});
    double flux = 0;  // ∫ 2π x^t dx
    constexpr int n = 100000;
    const double edge = std::max(0.5, tightness < 0 ? std::pow(10, 36 / static_cast<double>(tightness)) : 0);
    for (int i = 0; i < n; ++i)
      flux += 2 * pi * std::pow(edge + (1 - edge) * (i + 0.5) / n, tightness) * (1 - edge) / n;
    EXPECT_NEAR(emitter.flux / flux, 1, 1e-5) << tightness;
  }
}

}  // namespace
}  // namespace vitrail::test::fading_lights_test
