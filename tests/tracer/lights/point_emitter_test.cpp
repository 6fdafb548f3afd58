// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/point_emitter.h"

#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"
#include "tests/tracer/lights/light_fixtures.h"

namespace vitrail::point_emitter_test {

namespace {

using test::Random;

double intensity_along(const PointEmitter& e, Vector3d direction) {
  return static_cast<double>(intensity(e, normalize(direction), nullptr, test::some_wavelengths())[2]);
}

// ∫ I dω by 400² directions.
double flux_of(const PointEmitter& e) {
  double sum = 0;
  constexpr int n = 400;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      sum +=
          intensity_along(e, sphere_direction(SphereProjection::equal_area, {(x + 0.5) / n, (y + 0.5) / n}));
  return sum * 4 * pi / (n * n);
}

// look_at(origin = (1,2,3), target = (0,0.5,0), up = +y) in Mitsuba, +x on the left.
Transform mitsuba_look_at() { return look_at({1, 2, 3}, {0, 0.5, 0}, {0, 1, 0}); }

}  // namespace

TEST(PointEmitter, PointShinesAlikeEverywhere) {
  const PointLight light{{1, 2, 3}, ConstantSpectrum{4}};
  const PointEmitter e = make_emitter(light);
  EXPECT_EQ(intensity_along(e, {0.3, -2, 1}), 4);
  EXPECT_NEAR(e.flux, 16 * pi, 1e-4);
}

TEST(PointEmitter, SpotFallsAsItsKindSays) {
  for (const auto falloff :
       {SpotLight::Falloff::smoothstep, SpotLight::Falloff::quartic, SpotLight::Falloff::linear}) {
    SpotLight light;
    light.intensity = ConstantSpectrum{2};
    light.beam_deg = 20;
    light.cutoff_deg = 40;
    light.falloff = falloff;
    const PointEmitter e = make_emitter(light);
    const auto at = [&](double deg) {
      return intensity_along(e, {portable_sin(deg * pi / 180), 0, portable_cos(deg * pi / 180)});
    };
    EXPECT_EQ(at(0), 2);
    EXPECT_EQ(at(19.9), 2);
    EXPECT_EQ(at(40.1), 0);
    EXPECT_EQ(at(180), 0);
    const double b = portable_cos(pi / 9), c = portable_cos(2 * pi / 9),
                 x = (portable_cos(pi / 6) - c) / (b - c);
    const double expected = falloff == SpotLight::Falloff::linear    ? 0.5
                            : falloff == SpotLight::Falloff::quartic ? x * x * x * x
                                                                     : x * x * (3 - 2 * x);
    EXPECT_NEAR(at(30), 2 * expected, 1e-6);
    EXPECT_NEAR(e.flux, flux_of(e), 0.15 * flux_of(e));
  }
}

TEST(PointEmitter, SpotsOfEveryAngleAreFinite) {
  for (const float cutoff : {0.0f, 1e-6f, 45.0f, 90.0f, 180.0f})
    for (const float beam : {0.0f, cutoff})
      for (const auto falloff : {SpotLight::Falloff::smoothstep, SpotLight::Falloff::linear}) {
        SpotLight light;
        light.intensity = ConstantSpectrum{1};
        light.beam_deg = beam;
        light.cutoff_deg = cutoff;
        light.falloff = falloff;
        const PointEmitter e = make_emitter(light);
        for (const Vector3d d : {Vector3d{0, 0, 1}, Vector3d{0, 0, -1}, Vector3d{1, 0, 0}, Vector3d{1, 1, 1}})
          EXPECT_TRUE(std::isfinite(intensity_along(e, d)));
        EXPECT_GE(e.flux, 0);
      }
}

// sample_direction of Mitsuba 3.9.1 (scalar_rgb): irradiance across the direction at a point.
TEST(PointEmitter, SpotAndProjectorAgreeWithMitsuba) {
  struct Case {
    Point3d p;
    double spot, projector;
  };
  const Case cases[]{
      {{0.10159580514915101, 0.41629564523620965, -0.41819052217411135}, 0.13333976, 0.22122106},
      {{0.02165521039532603, 0.7858939086953094, 0.7925861778668761}, 0.27382678, 0.45701066},
      {{-0.7488293790723275, -0.5855142437236265, -0.8970655933983402}, 0.080223314, 0.13595413},
      {{-0.11838031269872706, -0.9402475782428661, -0.08633355121057784}, 0.077128306, 0.19274175},
      {{0.2982880952295215, -0.4430254347040494, 0.35250980396026255}, 0.110350534, 0.27834794},
      {{0.18172563483270165, -0.9520362352456693, 0.11770817598176397}, 0.06712765, 0.2218303},
      {{-0.4814951061850692, -0.1697976059798607, -0.4329498364573625}, 0.10702058, 0.17989157},
      {{0.38627583662599263, -0.11909256465852103, -0.6862645230500735}, 0.10836728, 0.18549338}};
  SpotLight spot;
  spot.light_to_world = mitsuba_look_at();
  spot.intensity = ConstantSpectrum{2};
  spot.cutoff_deg = 30;
  spot.beam_deg = 12;
  spot.falloff = SpotLight::Falloff::linear;
  ProjectionLight projector;
  projector.light_to_world = mitsuba_look_at();
  projector.image = Spectrum{ConstantSpectrum{0.7f}};
  projector.scale = ConstantSpectrum{1.5f};
  projector.fov_deg = 40;
  projector.irradiance = true;
  const PointEmitter s = make_emitter(spot), p = make_emitter(projector, 1, nullptr);
  for (const Case& c : cases) {
    const Vector3d d = c.p - s.position;
    EXPECT_NEAR(intensity_along(s, d) / dot(d, d), c.spot, 2e-6);
    EXPECT_NEAR(intensity_along(p, d) / dot(d, d), c.projector, 4e-6);
  }
}

TEST(PointEmitter, ProjectionsHaveTheirPower) {
  for (const double aspect : {0.5, 1.0, 2.0}) {
    ProjectionLight light;
    light.light_to_world = translate({1, 0, 0}) * rotate(1, {1, 1, 0});
    light.image = Spectrum{ConstantSpectrum{3}};
    light.fov_deg = 60;
    light.power = 100.0f;
    const PointEmitter e = make_emitter(light, aspect, nullptr);
    EXPECT_NEAR(flux_of(e), 100, 1);
    EXPECT_NEAR(e.flux, 100, 1e-3);
    light.scale = ConstantSpectrum{2.5f};  // still multiplies it, as in pbrt-v4
    const PointEmitter scaled = make_emitter(light, aspect, nullptr);
    EXPECT_NEAR(flux_of(scaled), 250, 2.5);
    EXPECT_NEAR(scaled.flux, 250, 1e-2);
    const Vector3d axis = transform_vector(light.light_to_world, {0, 0, 1});
    EXPECT_GT(intensity_along(e, axis), 0);
    EXPECT_EQ(intensity_along(e, -axis), 0);
    // The shorter axis spans ±30°.
    const Vector3d across =
        transform_vector(light.light_to_world, aspect < 1 ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0});
    EXPECT_GT(intensity_along(e, axis + across * 0.576), 0);
    EXPECT_EQ(intensity_along(e, axis + across * 0.579), 0);
  }
}

TEST(PointEmitter, GoniometricImageHasItsUpOnTheLightsY) {
  // 4 × 4 equal-area texels: the upper hemisphere (map +z) is the inner diamond.
  std::vector<double> values(16, 1);
  for (const std::size_t i : {5u, 6u, 9u, 10u}) values[i] = 7;
  GoniometricLight light;
  light.intensity = ConstantSpectrum{2};
  const auto image = std::make_shared<test::GreyImage>(4, 4, values);
  const PointEmitter e = make_emitter(light, image);
  EXPECT_EQ(intensity_along(e, {0.01, 1, 0.01}), 14);
  EXPECT_EQ(intensity_along(e, {0.01, -1, 0.01}), 2);
  EXPECT_NEAR(flux_of(e), e.flux, 0.01 * e.flux);
  light.power = 30.0f;
  EXPECT_NEAR(flux_of(make_emitter(light, image)), 2 * 30, 0.6);
}

}  // namespace vitrail::point_emitter_test
