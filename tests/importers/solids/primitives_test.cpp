// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/primitives.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/pi.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/solids/solid_checks.h"

namespace vitrail::solids::primitives_test {
namespace {

TEST(Primitives, BoxHasItsCornersAndVolume) {
  const Solid made = box({3, 1, -1}, {1, 2, 4});
  expect_sound(made, 0.999);
  EXPECT_DOUBLE_EQ(volume(made), 2 * 1 * 5);
  EXPECT_EQ(bounds_of(made), (Bounds3d{{1, 1, -1}, {3, 2, 4}}));
  EXPECT_THROW(box({0, 0, 0}, {1, 0, 1}), Error);
}

TEST(Primitives, SphereIsWithinItsDeviation) {
  for (const double deviation : {1e-2, 5e-4, 1e-4}) {
    const Solid made = sphere({1, 2, 3}, 2, {deviation});
    expect_sound(made, 0.9);
    const double far = greatest_distance(made, [](Point3d p) { return length(p - Point3d{1, 2, 3}) - 2; });
    EXPECT_LT(far, deviation * 4);
    EXPECT_GT(far, deviation * 4 / 10);  // and not much finer than was asked for
    EXPECT_NEAR(volume(made), 4 * pi / 3 * 8, 8 * 4 * pi * deviation * 4);
  }
}

TEST(Primitives, ConesAndCylindersHaveTheirVolume) {
  const Solid tube = cylinder({1, 0, 0}, {1, 0, 5}, 2, false);
  expect_sound(tube, 0.99);
  EXPECT_NEAR(volume(tube), 4 * pi * 5, 0.15);
  const Solid whole = cone({{0, 0, 0}, 2, {1, 2, 3}, 1, false});
  expect_sound(whole, 0.99);
  EXPECT_NEAR(volume(whole), pi * std::sqrt(14.0) / 3 * (4 + 2 + 1), 0.1);
  const Solid pointed = cone({{0, 1, 0}, 0, {0, 3, 0}, 1, false});
  expect_sound(pointed, 0.99);
  EXPECT_NEAR(volume(pointed), pi * 2 / 3, 0.01);
}

TEST(Primitives, OpenCapsCloseTheSolidButAreNotSeen) {
  const Solid open = cylinder({0, 0, 0}, {0, 1, 0}, 1, true),
              whole = cylinder({0, 0, 0}, {0, 1, 0}, 1, false);
  expect_sound(open, 0.99);
  EXPECT_EQ(volume(open), volume(whole));
  EXPECT_EQ(mesh_of(open).triangles.size(), whole.triangles.size() / 2);
  EXPECT_EQ(mesh_of(whole).triangles.size(), whole.triangles.size());
  EXPECT_TRUE(mesh_of(open, 1).triangles.empty());
}

TEST(Primitives, DiscLooksWhereItsNormalPoints) {
  const Solid made = disc({1, 2, 3}, {0, 0, -2}, 2, 1);
  EXPECT_FALSE(made.closed);
  double area = 0;
  for (const auto& t : made.triangles) {
    const auto p = [&](std::size_t i) { return made.positions[t[i]]; };
    area += cross(p(1) - p(0), p(2) - p(0)).z / 2;
    EXPECT_EQ(p(0).z, 3);
  }
  EXPECT_NEAR(area, -3 * pi, 0.02);
  EXPECT_EQ(made.normals[0][0].z, -1);
}

TEST(Primitives, TorusIsWithinItsDeviation) {
  const Solid made = torus(2, 0.5);
  expect_sound(made, 0.95);
  EXPECT_NEAR(volume(made), 2 * pi * pi * 2 * 0.25, 0.05);
  EXPECT_LT(
      greatest_distance(made, [](Point3d p) { return std::hypot(std::hypot(p.x, p.z) - 2, p.y) - 0.5; }),
      5e-4 * 5);
  // That of which the tube's radius is greater has its outer surface.
  const Solid spindle = torus(0.5, 1);
  expect_sound(spindle, 0.9);
  EXPECT_LT(
      greatest_distance(spindle, [](Point3d p) { return std::hypot(std::hypot(p.x, p.z) - 0.5, p.y) - 1; }),
      5e-4 * 3);
}

TEST(Primitives, OvusTouchesBothSpheres) {
  for (const double top : {0.0, 0.5, 1.0, 1.5, 1.9}) {
    const Solid made = ovus(1, top);
    expect_sound(made, 0.9);
    const Bounds3d b = bounds_of(made);
    EXPECT_NEAR(b.upper.y, 1 + top, 1e-12);
    EXPECT_NEAR(b.lower.y, -1, 1e-12);
    // No point is inside of either sphere, by more than the deviation.
    for (const Point3d& p : made.positions) {
      EXPECT_GT(length(p - Point3d{}), 1 - 1e-9);
      EXPECT_GT(length(p - Point3d{0, 1, 0}), top - 1e-9);
    }
  }
  EXPECT_NEAR(bounds_of(ovus(1, 3)).lower.y, -2, 1e-12);
}

TEST(Primitives, SuperellipsoidSatisfiesItsEquation) {
  for (const auto& [e, n] : {std::array{1.0, 1.0}, {0.25, 0.25}, {0.1, 1.0}, {1.5, 2.0}, {2.0, 0.5}}) {
    const Solid made = superellipsoid(e, n);
    expect_sound(made, -1.01);
    const auto equation = [e = e, n = n](Point3d p) {
      const double xy = std::pow(std::abs(p.x), 2 / e) + std::pow(std::abs(p.y), 2 / e);
      return std::pow(std::pow(xy, e / n) + std::pow(std::abs(p.z), 2 / n), n / 2);  // 1 on it; scales with p
    };
    for (const Point3d& p : made.positions) EXPECT_NEAR(equation(p), 1, 1e-9);
    EXPECT_LT(
        greatest_distance(made, [&](Point3d p) { return length(p - Point3d{}) * (1 - 1 / equation(p)); }),
        1.5 * 5e-4 * 2);
  }
  EXPECT_NEAR(volume(superellipsoid(1, 1)), 4 * pi / 3, 0.01);
}

TEST(Primitives, MirrorsKeepFrontsOutside) {
  expect_sound(transformed(sphere({0, 0, 0}, 1), scale({-1, 2, 3})), 0.9);
  EXPECT_THROW(transformed(sphere({0, 0, 0}, 1), scale({0, 1, 1})), Error);
  EXPECT_TRUE(mesh_of(box({0, 0, 0}, {1, 1, 1})).positions.size() == 24);
}

}  // namespace
}  // namespace vitrail::solids::primitives_test
