// SPDX-License-Identifier: Apache-2.0
#include "scene/geometry/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene/system/diagnostics.h"

namespace vitrail::motion_test {
namespace {

constexpr double degree = 0.017453292519943295;

void expect_near(const Transform& a, const Transform& b, double tolerance) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(a.m[i][j], b.m[i][j], tolerance) << i << ',' << j;
}

TEST(Motion, TurnsEvenlyMovesStraightAndStretchesEvenly) {
  const Vector3d axis{1, 2, -1};
  const auto placed = [&](Vector3d to, double angle, Vector3d size) {
    return translate(to) * rotate(angle * degree, axis) * scale(size);
  };
  const Motion motion({{2, placed({1, 2, 3}, 20, {1, 2, 3})}, {4, placed({3, 2, -1}, 140, {2, 2, 1})}});
  expect_near(motion.at(2.5), placed({1.5, 2, 2}, 50, {1.25, 2, 2.5}), 1e-14);
  expect_near(motion.at(3.5), placed({2.5, 2, 0}, 110, {1.75, 2, 1.5}), 1e-14);
}

TEST(Motion, StandsStillBeforeAndAfter) {
  const Transform a = rotate(1, {0, 0, 1}), b = rotate(2, {0, 0, 1}) * translate({1, 0, 0});
  const Motion motion({{0, a}, {1, b}});
  EXPECT_EQ(motion.at(-1), a);
  EXPECT_EQ(motion.at(0), a);
  EXPECT_EQ(motion.at(1), b);
  EXPECT_EQ(motion.at(7), b);
  const Motion sheared({{0, a * scale({1, 2, 3}) * a}, {1, b}});
  EXPECT_EQ(sheared.at(0), a * scale({1, 2, 3}) * a) << "to the bit, though its parts are rounded";
}

TEST(Motion, GoesThroughEveryKeyframe) {
  const Motion motion({{0, translate({0, 0, 0})}, {1, translate({2, 0, 0})}, {3, translate({2, 4, 0})}});
  expect_near(motion.at(0.5), translate({1, 0, 0}), 1e-15);
  expect_near(motion.at(1), translate({2, 0, 0}), 1e-15);
  expect_near(motion.at(2.5), translate({2, 3, 0}), 1e-15);
}

// The shorter way round, mirrors too: a turn by 300° is one by −60°.
TEST(Motion, TurnsTheShorterWay) {
  for (const double mirror : {1.0, -1.0}) {
    const Transform m = scale({mirror, 1, 1});
    const Motion motion({{0, m}, {1, rotate(300 * degree, {0, 0, 1}) * m}});
    expect_near(motion.at(0.5), rotate(-30 * degree, {0, 0, 1}) * m, 1e-14);
  }
}

TEST(Motion, TinyTurnsAreExact) {
  const Motion motion({{0, {}}, {1, rotate(1e-9, {0, 1, 0})}});
  expect_near(motion.at(0.25), rotate(0.25e-9, {0, 1, 0}), 1e-16);
}

Transform random_transform(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  Transform t;
  do
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) t.m[i][j] = u(random) * (j == 3 ? 5 : 1);
  while (!(determinant3(t) > 0.05));
  return t;
}

// Sheared ones too: what lies between keyframes is R·S of both, and meets them.
TEST(Motion, MeetsItsKeyframes) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Transform a = random_transform(random), b = random_transform(random);
    const Motion motion({{0, a}, {1, b}});
    expect_near(motion.at(1e-13), a, 1e-11);
    expect_near(motion.at(1 - 1e-13), b, 1e-11);
    EXPECT_GT(determinant3(motion.at(0.5)), 0);
  }
}

TEST(Motion, SweptBoundsHoldAllThatMovesAndLittleMore) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 100; ++i) {
    const Motion motion({{0, random_transform(random)}, {1, random_transform(random)}});
    const Bounds3d box{{-1, 0, 1}, {1, 2, 4}}, swept = motion.swept(box);
    Bounds3d seen;
    for (int k = 0; k <= 2000; ++k) {
      const Transform m = motion.at(k / 2000.0);
      for (int corner = 0; corner < 8; ++corner)
        extend(seen,
               transform_point(m, {corner & 1 ? 1.0 : -1.0, corner & 2 ? 2.0 : 0.0, corner & 4 ? 4.0 : 1.0}));
      const Point3d p = transform_point(m, {2 * u(random) - 1, 2 * u(random), 1 + 3 * u(random)});
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_TRUE(swept.lower[axis] <= p[axis] && p[axis] <= swept.upper[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(swept.lower[axis], seen.lower[axis]);
      EXPECT_GE(swept.upper[axis], seen.upper[axis]);
      const double beside = 0.05 * (seen.upper[axis] - seen.lower[axis]);
      EXPECT_GE(swept.lower[axis], seen.lower[axis] - beside);
      EXPECT_LE(swept.upper[axis], seen.upper[axis] + beside);
    }
  }
}

// A straight way needs no margin.
TEST(Motion, SweptBoundsOfStraightWaysAreTight) {
  const Bounds3d swept = Motion({{0, {}}, {1, translate({4, 0, 0})}}).swept({{0, 0, 0}, {1, 1, 1}});
  EXPECT_NEAR(swept.lower.x, 0, 1e-12);
  EXPECT_NEAR(swept.upper.x, 5, 1e-12);
  EXPECT_NEAR(swept.upper.y, 1, 1e-12);
}

TEST(Motion, RefusesWhatHasNoWayBetween) {
  Transform projective;
  projective.m[3][2] = 1;
  EXPECT_TRUE(can_move({{0, {}}, {1, translate({1, 0, 0})}}));
  EXPECT_FALSE(can_move({}));
  EXPECT_FALSE(can_move({{0, {}}, {0, translate({1, 0, 0})}}));
  EXPECT_FALSE(can_move({{1, {}}, {0, translate({1, 0, 0})}}));
  EXPECT_FALSE(can_move({{0, {}}, {1, scale({-1, 1, 1})}}));
  EXPECT_FALSE(can_move({{0, {}}, {1, scale({0, 1, 1})}}));
  EXPECT_FALSE(can_move({{0, projective}, {1, {}}}));
  EXPECT_THROW(Motion({{0, {}}, {1, scale({-1, 1, 1})}}), Error);
}

TEST(Motion, StandsStillWhereTheShutterSeesNoChange) {
  const Motion motion({{1, {}}, {2, translate({1, 0, 0})}, {3, translate({1, 0, 0})}});
  EXPECT_TRUE(stands_still({}, {0, 1}));
  EXPECT_TRUE(stands_still(motion, {0, 1}));
  EXPECT_TRUE(stands_still(motion, {2, 5}));
  EXPECT_TRUE(stands_still(motion, {1.5, 1.5}));
  EXPECT_FALSE(stands_still(motion, {1.5, 1.6}));
  EXPECT_FALSE(stands_still(motion, {0, 9}));
}

}  // namespace
}  // namespace vitrail::motion_test
