// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/sky_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "scene/daylight/patch_skies.h"
#include "scene/daylight/sky_distribution.h"
#include "scene/geometry/pi.h"

namespace vitrail::sky_patches_test {
namespace {

Vector3d towards(double azimuth_deg, double elevation_deg) {
  return direction_of({elevation_deg, azimuth_deg});
}

TEST(SkyPatches, AreAsManyAsReinhartHas) {
  for (const auto& [mf, patches] : {std::pair{1, 145u}, {2, 577u}, {4, 2305u}}) {
    const SkyPatches sky(mf);
    EXPECT_EQ(sky.count(), patches + 1);
    double above = 0;
    for (std::size_t p = 1; p < sky.count(); ++p) above += sky.solid_angle(p);
    EXPECT_NEAR(above, 2 * pi, 1e-12);
    EXPECT_EQ(sky.solid_angle(0), 2 * pi);
  }
}

// As Radiance's gendaymtx: the ground, then from north to east in each row, the zenith last.
TEST(SkyPatches, AreNumberedFromNorthToEast) {
  const SkyPatches sky(1);
  EXPECT_EQ(sky.patch_of(towards(0, -0.1)), 0u);
  EXPECT_EQ(sky.patch_of(towards(0, 1)), 1u);
  EXPECT_EQ(sky.patch_of(towards(-5.9, 1)), 1u);
  EXPECT_EQ(sky.patch_of(towards(6.1, 1)), 2u);
  EXPECT_EQ(sky.patch_of(towards(90, 6)), 1u + 30 / 4 + 1);
  EXPECT_EQ(sky.patch_of(towards(-6.1, 1)), 30u);
  EXPECT_EQ(sky.patch_of(towards(0, 12.5)), 31u);  // 90/7.5 = 12 degrees
  EXPECT_EQ(sky.patch_of(towards(0, 83)), 139u);
  EXPECT_EQ(sky.patch_of(towards(0, 85)), 145u);
  EXPECT_EQ(sky.patch_of({0, 0, 1}), 145u);
}

TEST(SkyPatches, DirectionsLieInTheirPatch) {
  for (const int mf : {1, 2, 4}) {
    const SkyPatches sky(mf);
    for (std::size_t p = 0; p < sky.count(); ++p)
      for (const double u : {0.01, 0.5, 0.99})
        for (const double v : {0.01, 0.5, 0.99})
          EXPECT_EQ(sky.patch_of(sky.direction(p, u, v)), p) << mf << ", " << u << ", " << v;
  }
}

TEST(PatchSkies, GiveTheIlluminanceOfTheSky) {
  const Vector3d to_sun = towards(150, 40);
  const SkyDistribution clear = perez_sky(700, 90, {40, 150}, {2025, 3, 21, 11, 0}).distribution;
  ASSERT_GT(clear.diffuse_lx, 1000);
  for (const int mf : {1, 2, 4}) {
    const SkyPatches patches(mf);
    const std::vector<double> luminances = PatchSkies(patches).luminances(clear, to_sun);
    double lx = 0;
    std::size_t brightest = 1;
    for (std::size_t p = 1; p < patches.count(); ++p) {
      constexpr int side = 16;
      double height = 0;
      for (int i = 0; i < side * side; ++i)
        height += patches.direction(p, (i % side + 0.5) / side, (i / side + 0.5) / side).z / (side * side);
      lx += luminances[p] * height * patches.solid_angle(p);
      if (luminances[p] > luminances[brightest]) brightest = p;
    }
    EXPECT_NEAR(lx / clear.diffuse_lx, 1, 1e-3);
    EXPECT_EQ(brightest, patches.patch_of(to_sun)) << mf;
    EXPECT_EQ(luminances[0], 0);
  }
}

TEST(PatchSkies, AreEvenUnderAUniformSky) {
  const SkyPatches patches(2);
  const SkyDistribution uniform{.a = 0, .b = -1, .base = 1, .c = 0, .d = -1, .e = 0, .diffuse_lx = 1000};
  const std::vector<double> luminances = PatchSkies(patches).luminances(uniform, {0, 0, 1});
  for (std::size_t p = 1; p < luminances.size(); ++p) EXPECT_NEAR(luminances[p], 1000 / pi, 0.1);
}

}  // namespace
}  // namespace vitrail::sky_patches_test
