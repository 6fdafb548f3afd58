// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/sky_distribution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/daylight/photometry.h"
#include "scene/daylight/sky_model.h"
#include "scene/geometry/pi.h"

namespace vitrail::sky_distribution_test {
namespace {

constexpr SunPosition sun{.elevation_deg = 35, .azimuth_deg = 150};
constexpr LocalTime spring{2026, 3, 21, 12, 1};

double lux(const std::array<double, sky_bands>& bands) {
  return photometric(to_xyz(spectrum_of_bands(bands)).y);
}
SkyModel model_of(const SkyDistribution& distribution, const SunPosition& at = sun) {
  SkyLight light;
  light.to_sun = direction_of(at);
  *light.distribution = distribution;
  return SkyModel(light);
}
Vector3d direction(double height_deg, double azimuth_deg) { return direction_of({height_deg, azimuth_deg}); }

// By the formula of the standard, with its own three numbers in the angles.
double relative_luminance(const double (&k)[5], Vector3d d) {
  const double chi = std::acos(std::clamp(dot(d, direction_of(sun)), -1.0, 1.0));
  return (1 + k[0] * std::exp(k[1] / d.z)) *
         (1 + k[2] * (std::exp(k[3] * chi) - std::exp(k[3] * pi / 2)) + k[4] * std::cos(chi) * std::cos(chi));
}

TEST(SkyDistribution, CieSkiesFollowTheirFormula) {
  struct Type {
    int number;
    double shape[5];
  };
  constexpr Type types[] = {{1, {4, -0.7, 0, -1, 0}},
                            {4, {1.1, -0.8, 2, -1.5, 0.15}},
                            {8, {0, -1, 10, -3, 0.45}},
                            {12, {-1, -0.32, 10, -3, 0.45}},
                            {15, {-1, -0.15, 24, -2.8, 0.15}}};
  for (const auto& [type, k] : types) {
    const SkyModel model = model_of(cie_sky(type, sun, spring).distribution);
    const double zenith = lux(model.sky({0, 0, 1}));
    for (const double height : {2.0, 20.0, 35.0, 70.0})
      for (const double azimuth : {0.0, 100.0, 150.0, 200.0}) {
        const Vector3d d = direction(height, azimuth);
        const double expected = relative_luminance(k, d) / relative_luminance(k, {0, 0, 1});
        EXPECT_NEAR(lux(model.sky(d)) / zenith, expected, 2e-3 * expected) << type << " " << height;
      }
  }
}

TEST(SkyDistribution, TheGroundGetsTheIlluminanceThatIsGiven) {
  for (int type = 1; type <= 15; ++type) {
    SkyDistribution sky = cie_sky(type, sun, spring).distribution;
    sky.diffuse_lx = 12345;
    EXPECT_NEAR(lux(model_of(sky).sky_irradiance()), 12345, 1) << type;
  }
}

// ½ of what the ground gets; of the overcast one .3792, by ∫ L sin²θ dθ ÷ π ∫ L cos θ sin θ dθ.
TEST(SkyDistribution, WallsUnderUniformAndOvercastSkies) {
  const SkyModel uniform = model_of(cie_sky(5, sun, spring).distribution);
  const SkyModel overcast = model_of(cie_sky(1, sun, spring).distribution);
  for (const Vector3d wall : {Vector3d{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}) {
    EXPECT_NEAR(lux(uniform.sky_irradiance(wall)) / lux(uniform.sky_irradiance()), 0.5, 1e-3);
    EXPECT_NEAR(lux(overcast.sky_irradiance(wall)) / lux(overcast.sky_irradiance()), 0.3792, 2e-4);
  }
}

TEST(SkyDistribution, CieSkiesHaveTheMeanIlluminanceOfTheirKind) {
  const double height = std::sin(sun.elevation_deg * radian);
  const MeasuredSky overcast = cie_sky(3, sun, spring), partly = cie_sky(8, sun, spring),
                    clear = cie_sky(13, sun, spring);
  EXPECT_NEAR(overcast.distribution.diffuse_lx, 300 + 21000 * height, 1);
  EXPECT_EQ(overcast.direct_normal_lx, 0);
  EXPECT_NEAR(partly.distribution.diffuse_lx, 300 + 45000 * height, 1);
  EXPECT_NEAR(clear.distribution.diffuse_lx, 800 + 15500 * std::sqrt(height), 1);
  EXPECT_NEAR(clear.direct_normal_lx / partly.direct_normal_lx, std::exp(0.59 / height), 1e-6);
}

// What Radiance's gendaylit (6.0a, -O 2) makes of the same irradiances: tests/conformance/sky_oracle.py. It
// normalises its sky by the sum over 145 directions, by which its zenith is off.
TEST(SkyDistribution, PerezSkiesAreThoseOfRadiance) {
  struct Moment {
    int month, day;
    double height_deg, azimuth_deg, direct_w, diffuse_w;
    double shape[5];  // a … e
    double zenith_cd, direct_lx;
  };
  constexpr Moment moments[] = {
      {3, 21, 39.1699, 161.1579, 0, 120, {0.911588, -0.606212, 0.463827, -0.384993, -0.032304}, 5199, 0},
      {6, 21, 47.8268, 111.2623, 30, 300, {-1.11062, -1.16832, 9.04839, -2.4739, 0.148527}, 9321, 2859},
      {9,
       10,
       42.7863,
       204.8720,
       120,
       330,
       {-1.02318, -1.31158, 9.40445, -2.60738, 0.111923},
       9469,
       1.147e+04},
      {12,
       21,
       16.9014,
       168.5292,
       150,
       110,
       {-1.17873, -0.746492, 9.81992, -2.90506, 0.11149},
       2116,
       1.207e+04},
      {6, 21, 28.4353, 86.0987, 300, 200, {-1.106, -0.848105, 11.6852, -3.09915, 0.072851}, 4241, 2.727e+04},
      {3,
       21,
       39.1699,
       161.1579,
       450,
       220,
       {-1.02669, -0.683339, 12.948, -3.19388, 0.025648},
       5438,
       4.273e+04},
      {9,
       10,
       28.7988,
       120.1171,
       600,
       120,
       {-0.945774, -0.326712, 13.1014, -3.40428, 0.322061},
       2686,
       5.709e+04},
      {6,
       21,
       64.5419,
       184.2702,
       900,
       90,
       {-0.993064, -0.214954, 22.9998, -6.02501, 1.37314},
       3811,
       9.325e+04},
      {1, 15, 14.9469, 151.1996, 2, 18, {0.91044, -0.711997, 0.12214, -0.152792, -0.092107}, 817, 34.56},
      {3,
       21,
       22.9933,
       240.1734,
       500,
       60,
       {-1.15108, -0.324854, 13.0174, -3.44172, 0.373128},
       1010,
       4.673e+04},
      {12, 21, 5.3079, 135.5494, 60, 40, {-1.21656, -0.756896, 9.22227, -2.73677, 0.108672}, 789.4, 2558},
      {7, 4, 61.8716, 152.5379, 1000, 60, {-1.00483, -0.228156, 22.9701, -6.32985, 1.29426}, 2250, 1.038e+05},
  };
  for (const Moment& m : moments) {
    const SunPosition at{m.height_deg, m.azimuth_deg};
    const MeasuredSky sky = perez_sky(m.direct_w, m.diffuse_w, at, {2026, m.month, m.day, 12, 1});
    const SkyDistribution& s = sky.distribution;
    const double found[5] = {s.a, s.b, s.c, s.d, s.e};
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(found[i], m.shape[i], 2e-4 * std::max(1.0, std::abs(m.shape[i]))) << m.month << " " << i;
    EXPECT_NEAR(sky.direct_normal_lx, m.direct_lx, 1e-3 * m.direct_lx) << m.month;
    EXPECT_NEAR(lux(model_of(s, at).sky({0, 0, 1})), m.zenith_cd, 0.02 * m.zenith_cd) << m.month;
  }
}

TEST(SkyDistribution, LuxAndWattsTellTheSameSky) {
  for (const auto& [direct_w, diffuse_w] : {std::pair{0.0, 120.0}, {300.0, 250.0}, {700.0, 110.0}}) {
    const MeasuredSky by_watts = perez_sky(direct_w, diffuse_w, sun, spring);
    const MeasuredSky by_lux =
        perez_sky_of_lux(by_watts.direct_normal_lx, by_watts.distribution.diffuse_lx, sun, spring);
    EXPECT_NEAR(by_lux.distribution.c, by_watts.distribution.c, 1e-6);
    EXPECT_NEAR(by_lux.distribution.a, by_watts.distribution.a, 1e-6);
    EXPECT_EQ(by_lux.direct_normal_lx, by_watts.direct_normal_lx);
  }
}

// Bright, dark, low and beyond all data: never negative, never without a bound.
TEST(SkyDistribution, ExtremesStayFinite) {
  for (const double height : {0.01, 0.5, 5.0, 45.0, 89.99})
    for (const double direct : {0.0, 1e-6, 100.0, 1400.0})
      for (const double diffuse : {1e-6, 1.0, 100.0, 1000.0}) {
        const SunPosition at{height, 120};
        const MeasuredSky sky = perez_sky(direct, diffuse, at, spring);
        ASSERT_TRUE(std::isfinite(sky.distribution.diffuse_lx) && std::isfinite(sky.direct_normal_lx));
        const SkyModel model = model_of(sky.distribution, at);
        for (const double up : {0.0, 0.001, 0.01, 1.0, 30.0, 90.0})
          for (const double azimuth : {0.0, 120.0, 300.0})
            for (const double radiance : model.sky(direction(up, azimuth)))
              ASSERT_TRUE(std::isfinite(radiance) && radiance >= 0)
                  << height << " " << direct << " " << diffuse;
      }
  EXPECT_EQ(perez_sky(100, 100, {-1, 0}, spring).distribution.diffuse_lx, 0);
  EXPECT_EQ(perez_sky(0, 0, sun, spring).direct_normal_lx, 0);
  const MeasuredSky bare = perez_sky(800, 0, sun, spring), again = perez_sky_of_lux(80000, 0, sun, spring);
  EXPECT_GT(bare.direct_normal_lx, 7e4);
  EXPECT_LT(bare.distribution.diffuse_lx, 1);
  EXPECT_EQ(again.direct_normal_lx, 80000);
  EXPECT_TRUE(std::isfinite(again.distribution.c));
}

}  // namespace
}  // namespace vitrail::sky_distribution_test
