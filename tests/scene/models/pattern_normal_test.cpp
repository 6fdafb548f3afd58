// SPDX-License-Identifier: Apache-2.0
// How patterns tilt normals: the tilts and the statistics that POV-Ray's pictures of planes show.
#include "scene/models/pattern_normal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scene/models/pattern.h"

namespace vitrail::pattern_normal_test {
namespace {

using Kind = PatternTexture::Kind;

PatternTexture of(Kind kind, const Transform& placed = {}) {
  PatternTexture t;
  t.kind = kind, t.texture_to_world = placed;
  return t;
}

// Of a plane whose normal is −z there, x and y of the new normal over −z of it.
Vector3d tilt(const PatternTexture& t, Vector3d v) {
  const Vector3d n = tilted_normal(t, {0, 0, -1}, v);
  return {n.x / -n.z, n.y / -n.z, 0};
}

Vector3d descent(const PatternTexture& t, Point3d p) {
  return descent_of_height(p, [&](Point3d q) { return bump_height * pattern_value(t, q); });
}

TEST(PatternNormals, TiltOfAGradient) {
  const Point3d p{0.4, 0.3, 0.2};
  const auto expect_tilt = [&](const Transform& placed, Vector3d direction, double x, double y) {
    PatternTexture t = of(Kind::gradient, placed);
    t.direction = direction;
    const Vector3d found = tilt(t, descent(t, p));
    EXPECT_NEAR(found.x, x, 1e-4);
    EXPECT_NEAR(found.y, y, 1e-4);
  };
  expect_tilt({}, {1, 0, 0}, -0.1333, 0);
  expect_tilt(scale({3, 3, 3}), {1, 0, 0}, -0.1333, 0);
  expect_tilt(scale({3, 1, 9}), {1, 0, 0}, -0.4, 0);
  expect_tilt(scale({3, 1, 1}), {1, 1, 0}, -0.0314, -0.0943);
  expect_tilt(scale({3, 6, 6}), {1, 1, 0}, -0.1886, -0.0943);
  expect_tilt(scale({3, 3, 3}), {1, 0, 1}, -0.0862, 0);  // what lies along the normal counts
}

TEST(PatternNormals, DescentIsThatOfTheHeight) {
  const Vector3d found =
      descent_of_height({1, 2, 3}, [](Point3d p) { return 0.5 * p.x - 2 * p.y + 0.25 * p.z + 7; });
  EXPECT_NEAR(found.x, -0.5, 1e-9);
  EXPECT_NEAR(found.y, 2, 1e-9);
  EXPECT_NEAR(found.z, -0.25, 1e-9);
}

struct Statistics {
  double mean = 0, deviation = 0, greatest = 0;
  double mean_x = 0, mean_y = 0;
};
Statistics statistics_of(const PatternTexture& t) {
  double sum = 0, squares = 0, greatest = 0, sum_x = 0, sum_y = 0;
  constexpr int wide = 300;
  for (int i = 0; i < wide; ++i)
    for (int j = 0; j < wide; ++j) {
      const Vector3d v = push_of_pattern(t, {i * 0.213 - 32, j * 0.213 - 32, 2.25});
      for (const double x : {v.x, v.y}) sum += x, squares += x * x;
      sum_x += v.x, sum_y += v.y;
      greatest = std::max(greatest, length(v));
    }
  const double count = 2.0 * wide * wide, mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean), greatest, 2 * sum_x / count, 2 * sum_y / count};
}

TEST(PatternNormals, StatisticsOfNoise) {
  const Statistics bumps = statistics_of(of(Kind::bumps));
  EXPECT_NEAR(bumps.mean, 0, 0.02);
  EXPECT_NEAR(bumps.deviation, 0.245, 0.005);
  const Statistics dents = statistics_of(of(Kind::dents));
  // The cube of a noise that pushes along x itself. A white plane with dents that povray 3.7 lights at 45°
  // from +x and −x, +z and −z is .3614, .3430, .3515 and .3528 bright: by this .026, and −.002, before it
  // normalises.
  EXPECT_NEAR(dents.mean_x, 0.026, 0.006);
  EXPECT_NEAR(dents.mean_y, 0, 0.005);
  EXPECT_NEAR(dents.deviation, 0.05, 0.01);
  const Statistics wrinkles = statistics_of(of(Kind::wrinkles));
  EXPECT_NEAR(wrinkles.mean, 0.42, 0.02);
  EXPECT_NEAR(wrinkles.deviation, 0.169, 0.005);
}

TEST(PatternNormals, StatisticsOfRings) {
  const Statistics ripples = statistics_of(of(Kind::ripples)), waves = statistics_of(of(Kind::waves));
  EXPECT_LE(ripples.greatest, 1);
  EXPECT_NEAR(ripples.deviation, 0.16, 0.03);
  EXPECT_NEAR(waves.deviation, 0.43, 0.05);
}

TEST(PatternNormals, RingsAreAsLongAsTheirFrequencySays) {
  // Far away all ten sources are in one direction: a unit on, ripples are as they were.
  PatternTexture t = of(Kind::ripples);
  t.frequency = 0.5f;
  for (int i = 0; i < 20; ++i) {
    const double x = 5e6 + 0.1 * i;
    const Vector3d here = push_of_pattern(t, {x, 0, 0}), there = push_of_pattern(t, {x + 2, 0, 0}),
                   half = push_of_pattern(t, {x + 1, 0, 0});
    EXPECT_NEAR(here.x, there.x, 1e-5);
    EXPECT_NEAR(here.x, -half.x, 1e-5);
  }
}

}  // namespace
}  // namespace vitrail::pattern_normal_test
