// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/environment.h"

#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"
#include "tests/tracer/lights/light_fixtures.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail::environment_test {

namespace {

using test::GreyImage;
using test::Random;
using enum EnvironmentLight::Projection;

// Dark but for a sun of one texel and a dim gradient.
std::shared_ptr<GreyImage> sunny(int width, int height) {
  std::vector<double> values;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      values.push_back(x == width / 3 && y == height * 3 / 4 ? 500 : 0.01 * x * y);
  return std::make_shared<GreyImage>(width, height, values);
}

SampledSpectrum seen(const Environment& e, Vector3d direction, const SampledWavelengths& w) {
  return value_towards(e, direction, w).radiance;
}

}  // namespace

TEST(SphereMap, GoesThereAndBack) {
  Random random(1);
  for (const auto projection : {equal_area, latitude_longitude})
    for (int i = 0; i < 1000; ++i) {
      const Vector3d d = random.direction();
      const Vector3d again = sphere_direction(projection, sphere_point(projection, d));
      EXPECT_LT(length(d - again), 1e-12);
    }
  // +z is the centre of the equal-area map, −z its corners; +x to the right.
  EXPECT_EQ(sphere_point(equal_area, {0, 0, 1}), (Point2d{0.5, 0.5}));
  EXPECT_EQ(sphere_point(equal_area, {1, 0, 0}), (Point2d{1, 0.5}));
  EXPECT_EQ(sphere_point(equal_area, {0, 1, 0}), (Point2d{0.5, 1}));
  EXPECT_NEAR(sphere_point(latitude_longitude, {0, 1, 0}).x, 0.25, 1e-15);
  EXPECT_EQ(sphere_point(latitude_longitude, {0, 0, 1}).y, 0);
}

TEST(DirectionTable, DensityIntegratesToOneAndSamplesHaveIt) {
  Random random(2);
  for (const auto projection : {equal_area, latitude_longitude}) {
    const int width = projection == equal_area ? 6 : 8, height = projection == equal_area ? 6 : 4;
    const DirectionTable table(projection, width, height,
                               [](int x, int y) { return (x * 7 + y * 3) % 5 == 0 ? 0.0 : 1.0 + x * y; });
    double sum = 0;
    std::vector<double> expected;
    std::vector<int> counts(static_cast<std::size_t>(width * height), 0);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Vector3d d = sphere_direction(projection, {(x + 0.5) / width, (y + 0.5) / height});
        expected.push_back(table.pdf(d) * table.cell_solid_angle(y));
        sum += expected.back();
      }
    EXPECT_NEAR(sum, 1, 1e-12);
    constexpr int samples = 100000;
    double inverse = 0;  // E[1/p] = the solid angle of where p > 0
    for (int i = 0; i < samples; ++i) {
      const Vector3d d = table.sample(random(), random());
      ASSERT_NEAR(length(d), 1, 1e-12);
      const double pdf = table.pdf(d);
      ASSERT_GT(pdf, 0);
      inverse += 1 / pdf / samples;
      const Point2d at = sphere_point(projection, d);
      ++counts[static_cast<std::size_t>(std::min(height - 1, static_cast<int>(at.y * height)) * width +
                                        std::min(width - 1, static_cast<int>(at.x * width)))];
    }
    double chi2 = 0, lit = 0;
    int freedom = -1;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double e = expected[i] * samples;
      if (e == 0) {
        EXPECT_EQ(counts[i], 0);
        continue;
      }
      chi2 += (counts[i] - e) * (counts[i] - e) / e;
      lit += table.cell_solid_angle(static_cast<int>(i) / width);
      ++freedom;
    }
    EXPECT_LT(chi2, freedom + 4 * std::sqrt(2.0 * freedom));
    EXPECT_NEAR(inverse, lit, 0.05 * lit);
  }
}

// One cell is the sphere: Σ z² and Σ |x| over uniform directions are 1/3 and 1/2.
TEST(DirectionTable, IsUniformPerSolidAngleWithinACell) {
  Random random(6);
  for (const auto projection : {equal_area, latitude_longitude}) {
    const DirectionTable table(projection, 1, 1, [](int, int) { return 1.0; });
    double z2 = 0, x = 0;
    constexpr int samples = 40000;
    for (int i = 0; i < samples; ++i) {
      const Vector3d d = table.sample(random(), random());
      z2 += d.z * d.z / samples;
      x += std::abs(d.x) / samples;
    }
    EXPECT_NEAR(z2, 1 / 3.0, 0.007);
    EXPECT_NEAR(x, 0.5, 0.007);
  }
}

TEST(Environment, SampledRadianceIsUnbiasedAndOfLowVariance) {
  Random random(3);
  for (const auto projection : {equal_area, latitude_longitude}) {
    EnvironmentLight light;
    light.projection = projection;
    light.light_to_world = rotate(0.7, {1, 2, 3});
    const Environment e = make_environment(light, sunny(32, projection == equal_area ? 32 : 16));
    const SampledWavelengths w = test::some_wavelengths();
    double brute = 0;
    constexpr int n = 1000;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Vector3d d = sphere_direction(equal_area, {(x + 0.5) / n, (y + 0.5) / n});
        brute += static_cast<double>(seen(e, d, w)[0]) * 4 * pi / (n * n);
      }
    constexpr int samples = 20000;
    const auto expect_mean = [&](auto&& draw) {
      double sum = 0, squares = 0;
      for (int i = 0; i < samples; ++i) {
        const double x = draw();
        sum += x / samples;
        squares += x * x / samples;
      }
      const double sigma = std::sqrt(std::max(0.0, squares - sum * sum));
      EXPECT_NEAR(sum, brute, 4 * sigma / std::sqrt(samples) + 2e-3 * brute);
      return sigma;
    };
    const auto drawn = [&](const DirectionTable& table) { return table.sample(random(), random()); };
    const auto light_at = [&](Vector3d d) { return static_cast<double>(seen(e, e.frame.to_world(d), w)[0]); };
    const DirectionTable alone = tabulate_image(*e.image, projection, false).table;
    const double sigma = expect_mean([&] {
      const Vector3d d = drawn(alone);
      return light_at(d) / alone.pdf(d);
    });
    EXPECT_LT(sigma, 0.5 * brute);  // uniform directions: 10 times the mean and more
    // Weighted beside uniform directions, as of a BSDF, the light's own density does better.
    const auto both = [&](const DirectionTable& table) {
      return expect_mean([&] {
        double x = 0;
        for (const Vector3d d : {drawn(table), random.direction()})
          x += light_at(d) / (table.pdf(d) + 1 / (4 * pi));
        return x;
      });
    };
    EXPECT_LT(both(e.table), 0.98 * both(alone));
    EXPECT_NEAR(e.mean_luminance * 4 * pi, brute, 0.02 * brute);
  }
}

TEST(Environment, IlluminanceIsThatOfAnUpwardPlane) {
  for (const auto projection : {equal_area, latitude_longitude}) {
    EnvironmentLight light;
    light.projection = projection;
    light.scale = ConstantSpectrum{3};
    light.illuminance = 50;
    const Environment e = make_environment(light, sunny(32, projection == equal_area ? 32 : 16));
    const SampledWavelengths w = test::some_wavelengths();
    double up = 0;
    constexpr int n = 800;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Vector3d d = sphere_direction(equal_area, {(x + 0.5) / n, (y + 0.5) / n});
        up += static_cast<double>(seen(e, d, w)[1]) * std::max(0.0, d.z) * 4 * pi / (n * n);
      }
    EXPECT_NEAR(up, 3 * 50, 0.5);
  }
}

TEST(Environment, EveryDirectionHasADensity) {
  const Environment e =
      make_environment({}, std::make_shared<GreyImage>(2, 2, std::vector<double>{0, 0, 9, 0}));
  Random random(4);
  for (int i = 0; i < 1000; ++i) EXPECT_GT(e.table.pdf(random.direction()), 0);
  const Environment black = make_environment({}, std::make_shared<GreyImage>(1, 1, std::vector<double>{0}));
  EXPECT_NEAR(black.table.pdf({0, 0, 1}), 1 / (4 * pi), 1e-12);
}

// An "envmap" of Mitsuba 3.9.1 (scalar_rgb) with these rows from the top and scale 2, evaluated at directions
// of its own frame; the transform is what its importer gives to it.
// The text in lanes and the model's own.
TEST(Environment, ShowsASkyAsItsModelHasItToTheBit) {
  SkyLight light;
  light.to_sun = normalize(Vector3d{0.5, -0.3, 0.4});
  light.ground = 0.3f;
  const Environment e = make_environment(light);
  const SkyModel sky(light);
  Random random(8);
  for (int i = 0; i < 100'000; ++i) {
    Vector3d d = random.direction();
    if (i % 4 == 0) d = normalize(light.to_sun + d * 0.01);
    if (i % 16 == 1) d = normalize(Vector3d{d.x, d.y, 0});
    if (i % 16 == 2) d = {0, 0, 1};
    const SampledWavelengths w = sample_wavelengths(static_cast<float>(random()));
    const SampledSpectrum found = seen(e, d, w), of_sky = sky.sky(d, w), of_sun = sky.sun(d, w);
    for (int k = 0; k < hero_count; ++k)
      ASSERT_EQ(found.v.data()[k], of_sky.v.data()[k] + of_sun.v.data()[k]) << i;
    if (d.z < -0.1) {
      ASSERT_GT(found.v.data()[0], 0) << i;
    }
  }
}

// Where glass makes the sun a light of its own, what the ground has of it remains.
TEST(Environment, HasTheGroundWithoutTheSun) {
  SkyLight light;
  light.to_sun = normalize(Vector3d{0.5, -0.3, 0.4});
  light.ground = 0.3f;
  light.sky_scale = 0;
  const Environment with = make_environment(light), without = make_environment(light, false);
  const SampledWavelengths w = sample_wavelengths(0.5f);
  const Vector3d down{0, 0.6, -0.8};
  EXPECT_GT(seen(without, down, w).v.data()[0], 0);
  EXPECT_EQ(seen(without, down, w).v.data()[0], seen(with, down, w).v.data()[0]);
  EXPECT_EQ(seen(without, light.to_sun, w).v.data()[0], 0);
  EXPECT_GT(without.table.pdf(down), 0);
  EXPECT_EQ(without.sun_share, 0);
}

TEST(Environment, AgreesWithMitsuba) {
  const std::vector<double> rows{1.5, 4.5, 7.5, 10.5, 6.5, 9.5, 1.5, 4.5, 10.5, 2.5, 5.5, 8.5};
  std::vector<double> upwards;
  for (std::size_t y = 3; y-- > 0;)
    for (std::size_t x = 0; x < 4; ++x) upwards.push_back(rows[4 * y + x]);
  EnvironmentLight light;
  light.projection = latitude_longitude;
  light.scale = ConstantSpectrum{2};
  light.light_to_world->m = {{{0, 1, 0, 0}, {0, 0, 1, 0}, {-1, 0, 0, 0}, {0, 0, 0, 1}}};
  const Environment e = make_environment(light, std::make_shared<GreyImage>(4, 3, upwards));
  struct Case {
    Vector3d direction;
    double value;
  };
  const Case cases[]{{{0.000000000, 0.999900000, 0.014141782}, 11.990996},
                     {{-0.399947560, 0.322579489, -0.857895345}, 11.375788},
                     {{0.903963827, -0.394371197, 0.165289923}, 15.262887},
                     {{-0.098234239, 0.575966811, -0.811549301}, 11.743237},
                     {{-0.260074456, -0.309793417, 0.914543228}, 8.354409},
                     {{-0.775778842, -0.121617617, -0.619173920}, 9.193894},
                     {{0.033876115, 0.467703458, -0.883236030}, 11.241102},
                     {{0.742676203, 0.584935882, 0.326009311}, 13.602381},
                     {{0.791893654, -0.601028114, -0.108026139}, 15.030128},
                     {{-0.844199277, -0.241673766, 0.478457283}, 5.273622}};
  for (const Case& c : cases)
    EXPECT_NEAR(static_cast<double>(seen(e, normalize(c.direction), test::some_wavelengths())[0]), c.value,
                2e-4);
}

}  // namespace vitrail::environment_test
