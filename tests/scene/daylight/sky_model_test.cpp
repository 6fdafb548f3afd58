// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/sky_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/daylight/photometry.h"
#include "scene/geometry/pi.h"
#include "scene/geometry/portable_math.h"

namespace vitrail::sky_model_test {
namespace {

constexpr std::array<float, 6> lambdas_nm{380, 450, 550, 600, 650, 700};

std::array<double, 6> radiances(const SkyModel& model, Vector3d d) {
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    SampledWavelengths w;
    w.lambda_nm.fill(lambdas_nm[i]);
    values[i] = static_cast<double>((model.sky(d, w) + model.sun(d, w))[0]);
  }
  return values;
}

struct Seen {
  Vector3d direction;
  std::array<double, 6> radiances;
};
const Vector3d sun = normalize(Vector3d{0.5, 0.3, 0.6});

void expect_as(const SkyLight& light, const std::vector<Seen>& reference, double sky_error,
               double sun_error) {
  const SkyModel model(light);
  for (const Seen& seen : reference) {
    const Vector3d d = normalize(seen.direction);
    const auto found = radiances(model, d);
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i] / seen.radiances[i], 1, model.meets_sun(d) ? sun_error : sky_error)
          << d.x << ' ' << d.y << ' ' << d.z << " at " << lambdas_nm[i];
  }
}

// Evaluated by Mitsuba 3.9.1, variant llvm_ad_spectral, emitter sunsky.
TEST(SkyModel, IsThatOfMitsuba) {
  SkyLight light;
  light.to_sun = sun;
  light.limb_darkening = false;
  expect_as(
      light,
      {{{0, 0, 1}, {8.224410e-02, 8.653176e-02, 4.128880e-02, 2.957802e-02, 2.106993e-02, 1.537529e-02}},
       {{0.3, -0.5, 0.2},
        {1.314432e-01, 1.722060e-01, 9.467371e-02, 6.866714e-02, 4.806652e-02, 3.457613e-02}},
       {{-1, 0, 0.02}, {1.365331e-01, 2.433071e-01, 2.010857e-01, 1.681365e-01, 1.298782e-01, 9.951212e-02}},
       {sun, {5.562091e+03, 1.357187e+04, 1.674561e+04, 1.744633e+04, 1.664944e+04, 1.574331e+04}}},
      1e-5, 3e-3);
  light.limb_darkening = true;
  light.turbidity = 5.4f;
  light.albedo = ConstantSpectrum{0.1f};
  expect_as(
      light,
      {{{0.51, 0.31, 0.59},
        {2.514812e-01, 4.705536e-01, 4.907591e-01, 4.575828e-01, 4.009672e-01, 3.401020e-01}},
       {{1, 1, 0.3}, {1.885245e-01, 3.296218e-01, 2.773962e-01, 2.459078e-01, 2.053523e-01, 1.682019e-01}},
       {sun, {7.036357e+03, 1.631762e+04, 1.904059e+04, 1.955073e+04, 1.845139e+04, 1.731762e+04}}},
      1e-5, 1e-3);
}

// Over all of the sky, denser at the horizon and around the sun, in every band.
TEST(SkyModel, CurvesAreThoseOfTheFormula) {
  double worst = 0;
  for (const float turbidity : {1.0f, 1.5f, 3.0f, 5.5f, 9.5f, 10.0f})
    for (const float albedo : {0.0f, 0.5f, 1.0f})
      for (const double elevation_deg : {0.0, 0.3, 2.0, 8.0, 20.0, 40.0, 70.0, 89.0, 90.0}) {
        SkyLight light;
        light.turbidity = turbidity;
        light.albedo = ConstantSpectrum{albedo};
        const double elevation = elevation_deg * pi / 180;
        light.to_sun = {portable_cos(elevation), 0, portable_sin(elevation)};
        const SkyModel model(light);
        const auto irradiance = model.sky_irradiance();
        const auto compare = [&](Vector3d d) {
          const auto exact = model.sky_by_formula(d), curves = model.sky(d);
          for (std::size_t b = 0; b < sky_bands; ++b)
            worst = std::max(worst, std::abs(curves[b] - exact[b]) / (exact[b] + irradiance[b] / (100 * pi)));
        };
        for (int i = 0; i <= 50; ++i)
          for (int j = 0; j <= 12; ++j) {
            const double theta = pi / 2 * (1 - i * i / 2500.0), phi = pi * j / 12;
            compare({portable_sin(theta) * portable_cos(phi), portable_sin(theta) * portable_sin(phi),
                     std::max(0.0, portable_cos(theta))});
          }
        for (int i = -60; i <= 60; ++i) {
          const double gamma = 0.5 * i * std::abs(i) / 3600.0, at = elevation + gamma;
          if (at >= 0) compare({portable_cos(at), 0, portable_sin(at)});
        }
      }
  EXPECT_LT(worst, 5e-6);
  EXPECT_GT(worst, 0);
}

// The disc's mean radiance times its solid angle is its irradiance, darkened or uniform, of any diameter.
TEST(SkyModel, SunHasItsIrradianceWhateverItsDisc) {
  SkyLight light;
  light.to_sun = sun;
  const auto darkened = SkyModel(light).sun_irradiance(sun);
  light.limb_darkening = false;
  light.sun_diameter_deg = 3;
  const SkyModel wide(light);
  const auto uniform = wide.sun_irradiance(sun);
  for (std::size_t b = 0; b < sky_bands; ++b) {
    EXPECT_NEAR(darkened[b] / uniform[b], 1, 2e-3);
    EXPECT_NEAR(uniform[b] / (wide.sun(sun)[b] * 2 * 3.14159265358979 * (1 - wide.sun_cosine())), 1, 1e-3);
    EXPECT_NEAR(wide.sun_irradiance({0, 0, 1})[b] / uniform[b], sun.z, 1e-3);
  }
}

TEST(SkyModel, NightAndBelowTheHorizonAreBlack) {
  SkyLight light;
  light.to_sun = sun;
  EXPECT_EQ(SkyModel(light).sky({0.6, 0, -0.8})[3], 0);
  light.to_sun = normalize(Vector3d{1, 0, -0.01});
  const SkyModel night(light);
  EXPECT_FALSE(night.is_day());
  EXPECT_EQ(night.sky({0, 0, 1})[3], 0);
  EXPECT_EQ(night.sun(light.to_sun)[3], 0);
  EXPECT_EQ(night.sky_irradiance()[3], 0);
}

// A wall has half of what the ground sends to all sides: ρ E/2, E the light of sun and sky on the ground.
TEST(SkyModel, GroundSendsItsShareToWalls) {
  SkyLight light;
  light.to_sun = sun;
  const auto lux = [](const auto& bands) { return photometric(luminance(spectrum_of_bands(bands))); };
  constexpr Vector3d up{0, 0, 1}, down{0, 0, -1}, wall{0.6, -0.8, 0};
  for (const bool given : {false, true}) {
    if (given) *light.distribution = SkyDistribution{.a = 4, .b = -0.7, .base = 1, .diffuse_lx = 10000};
    light.ground = 0;
    const SkyModel black(light);
    light.ground = 0.25f;
    const SkyModel model(light);
    const double on_the_ground = lux(black.sky_irradiance(up)) + lux(black.sun_irradiance(up));
    EXPECT_NEAR(lux(model.ground()) * pi, 0.25 * on_the_ground, 1e-6 * on_the_ground);
    EXPECT_EQ(model.sky({0.6, 0, -0.8}), model.ground());
    EXPECT_EQ(model.sky_irradiance(up), black.sky_irradiance(up));
    EXPECT_NEAR(lux(model.sky_irradiance(wall)), lux(black.sky_irradiance(wall)) + 0.25 * on_the_ground / 2,
                1e-6 * on_the_ground);
    EXPECT_NEAR(lux(model.sky_irradiance(down)), 0.25 * on_the_ground, 1e-6 * on_the_ground);
    const SkyModel shaded = model.without_sun();
    EXPECT_FALSE(shaded.has_sun());
    EXPECT_EQ(shaded.ground(), model.ground());
  }
  light.sky_scale = 0;
  const SkyModel alone(light);
  EXPECT_NEAR(lux(alone.ground()) * pi / lux(alone.sun_irradiance(up)), 0.25, 1e-6);
  light.to_sun = normalize(Vector3d{1, 0, -0.01});
  EXPECT_FALSE(SkyModel(light).has_ground());
}

// D65 is the daylight of 6504 K. Chromaticities are those of the CIE (15:2004, equations 3.3 and 3.4), but
// for the bands of 40 nm.
TEST(SkyModel, SkiesHaveTheDaylightOfATemperature) {
  SkyLight light;
  light.to_sun = sun;
  *light.distribution = SkyDistribution{.diffuse_lx = 10000};
  const SkyModel d65(light);
  light.color_temperature_k = 6504;
  for (std::size_t b = 0; b < sky_bands; ++b)
    EXPECT_NEAR(SkyModel(light).sky({0, 0, 1})[b] / d65.sky({0, 0, 1})[b], 1, 1e-3) << b;
  const std::pair<float, double> chromaticities[] = {
      {4000.0f, 0.3823}, {5000.0f, 0.3457}, {12000.0f, 0.2697}};
  for (const auto& [kelvin, x] : chromaticities) {
    light.color_temperature_k = kelvin;
    const TabulatedSpectrum sky = spectrum_of_bands(SkyModel(light).sky_irradiance());
    EXPECT_NEAR(photometric(luminance(sky)), 10000, 1);
    const XYZ color = to_xyz(sky);
    const double all = color.x + color.y + color.z;
    EXPECT_NEAR(color.x / all, x, 3.5e-3) << kelvin;
    EXPECT_NEAR(color.y / all, -3 * x * x + 2.87 * x - 0.275, 3.5e-3) << kelvin;
  }
}

TEST(SkyModel, GroundAndHazeBrightenTheSky) {
  SkyLight light;
  light.to_sun = sun;
  const auto lux = [&] {
    return photometric(luminance(spectrum_of_bands(SkyModel(light).sky_irradiance())));
  };
  const double usual = lux();
  light.albedo = ConstantSpectrum{0.8f};
  EXPECT_GT(lux(), usual);
  light.albedo = ConstantSpectrum{0.3f};
  light.turbidity = 6;
  EXPECT_GT(lux(), usual);
}

}  // namespace
}  // namespace vitrail::sky_model_test
