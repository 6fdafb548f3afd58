// SPDX-License-Identifier: Apache-2.0
#include "scene/geometry/transform.h"

#include <gtest/gtest.h>

#include <numbers>

namespace vitrail::transform_test {
namespace {

void expect_near(const Transform& a, const Transform& b, double tolerance) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(a.m[i][j], b.m[i][j], tolerance) << i << ' ' << j;
}

const Transform sheared =
    translate({1, 2, 3}) * rotate(0.7, {1, 2, -1}) * scale({2, 0.5, 3}) * rotate(-1.1, {0, 1, 0.3});

TEST(Transform, TimesItsInverseIsTheIdentity) {
  expect_near(sheared * inverse(sheared), {}, 1e-14);
  EXPECT_FALSE(is_invertible(scale({1, 0, 1})));
}

TEST(Transform, RotationIsRightHanded) {
  const Vector3d v = transform_vector(rotate(std::numbers::pi / 2, {0, 0, 1}), {1, 0, 0});
  EXPECT_NEAR(v.x, 0, 1e-15);
  EXPECT_NEAR(v.y, 1, 1e-15);
}

TEST(Transform, PointsMoveAndVectorsDoNot) {
  EXPECT_EQ(transform_point(translate({1, 2, 3}), {1, 1, 1}), (Point3d{2, 3, 4}));
  EXPECT_EQ(transform_vector(translate({1, 2, 3}), {1, 1, 1}), (Vector3d{1, 1, 1}));
}

TEST(Transform, NormalsStayPerpendicular) {
  const Vector3d u{1, 0.5, 0}, v{0, 1, -2};
  const Vector3d n = to_vector(transform_normal(sheared, to_normal(cross(u, v))));
  EXPECT_NEAR(dot(n, transform_vector(sheared, u)), 0, 1e-13);
  EXPECT_NEAR(dot(n, transform_vector(sheared, v)), 0, 1e-13);
}

TEST(Transform, MirrorsSwapHandedness) {
  EXPECT_TRUE(swaps_handedness(scale({-1, 1, 1})));
  EXPECT_FALSE(swaps_handedness(scale({-1, -1, 1})));
  EXPECT_NEAR(determinant3(sheared), 3, 1e-14);
}

TEST(LookAt, LooksAlongZWithUpUp) {
  const Transform camera = look_at({1, 2, 3}, {1, 2, 13}, {0, 1, 0});
  EXPECT_EQ(transform_point(camera, {0, 0, 0}), (Point3d{1, 2, 3}));
  EXPECT_EQ(transform_vector(camera, {0, 0, 1}), (Vector3d{0, 0, 1}));
  EXPECT_EQ(transform_vector(camera, {0, 1, 0}), (Vector3d{0, 1, 0}));
  EXPECT_EQ(transform_vector(camera, {1, 0, 0}), (Vector3d{1, 0, 0}));  // up × view
  EXPECT_FALSE(is_invertible(look_at({0, 0, 0}, {0, 1, 0}, {0, 1, 0})));
}

}  // namespace
}  // namespace vitrail::transform_test
