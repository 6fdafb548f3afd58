// SPDX-License-Identifier: Apache-2.0
// How patterns tilt normals: the tilts and the statistics that POV-Ray's pictures of planes show.
#include "scene/models/pattern_normal.h"

#include <gtest/gtest.h>

#include <array>
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
  double deviation = 0, greatest = 0;
};
Statistics statistics_of(const PatternTexture& t) {
  double sum = 0, squares = 0, greatest = 0;
  constexpr int wide = 300;
  for (int i = 0; i < wide; ++i)
    for (int j = 0; j < wide; ++j) {
      const Vector3d v = push_of_pattern(t, {i * 0.213 - 32, j * 0.213 - 32, 2.25});
      for (const double x : {v.x, v.y}) sum += x, squares += x * x;
      greatest = std::max(greatest, length(v));
    }
  const double count = 2.0 * wide * wide, mean = sum / count;
  return {std::sqrt(squares / count - mean * mean), greatest};
}

// By vturbulence() of one octave and f_noise_generator(), as povray 3.7 wrote them; that its normals are
// these is held by PovrayNoise.
TEST(PatternNormals, PushesOfNoiseArePovrays) {
  constexpr std::array<Point3d, 3> points{{{1.25, -3.5, 0.75}, {-7.1, 2.2, 5.9}, {103.4, -58.3, 17.6}}};
  const auto expect = [&](Kind kind, const std::array<Vector3d, 3>& expected) {
    SCOPED_TRACE(static_cast<int>(kind));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3d found = push_of_pattern(of(kind), points[i]);
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[i][axis], 1e-11) << i << axis;
    }
  };
  expect(Kind::bumps, {{{0.196472037964, -0.205540789551, 0.179681295776},
                        {-0.050171578553, 0.410014951360, 0.293954949703},
                        {0.081200480458, -0.131699997703, 0.010258976945}}});
  expect(Kind::dents, {{{0.044986298175, -0.047062774641, 0.041141713763},
                        {-0.005937296330, 0.048521101710, 0.034786580259},
                        {0.013904855057, -0.022552445118, 0.001756757924}}});
  expect(Kind::wrinkles, {{{0.437911866284, 0.405736306387, 0.337942156519},
                           {0.353058589379, 0.648247871426, 0.411847222536},
                           {0.404593246474, 0.371593551689, 0.310695136889}}});
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
