// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/csg.h"

#include <gtest/gtest.h>

#include <cmath>

#include "importers/solids/primitives.h"
#include "scene/geometry/pi.h"
#include "tests/importers/solids/solid_checks.h"

namespace vitrail::solids::csg_test {
namespace {

Csg cube(double low, double high, std::uint32_t surface = 0) {
  return solid(box({low, low, low}, {high, high, high}), surface);
}
Csg ball(Point3d center, double radius, std::uint32_t surface = 0, double deviation = 5e-4) {
  return solid(sphere(center, radius, {deviation}), surface);
}

void expect_volume(const CsgResult& result, double expected, double tolerance) {
  EXPECT_TRUE(result.refused.empty()) << result.refused.front();
  EXPECT_TRUE(is_watertight(result.solid));
  EXPECT_NEAR(volume(result.solid), expected, tolerance);
}

TEST(Csg, BoxesHaveTheVolumesOfTheirSets) {
  const auto both = [](auto operation) {
    std::vector<Csg> operands{cube(0, 2, 1), cube(1, 3, 2)};
    return evaluate(operation(operands));
  };
  expect_volume(both(intersection), 1, 1e-12);
  expect_volume(both(difference), 7, 1e-12);
  expect_volume(both(merge), 15, 1e-12);
  expect_volume(both(unite), 16, 1e-12);
}

TEST(Csg, TrianglesKeepTheSurfaceAndTheNormalsOfTheirOperand) {
  const CsgResult result = evaluate(difference({cube(0, 2, 7), ball({2, 2, 2}, 1, 9)}));
  expect_volume(result, 8 - pi / 6, 0.01);
  EXPECT_EQ(surfaces_of(result.solid), (std::vector<std::uint32_t>{7, 9}));
  for (std::size_t t = 0; t < result.solid.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3d p = result.solid.positions[result.solid.triangles[t][i]];
      const Vector3d n = to_vector(cast<double>(result.solid.normals[t][i]));
      if (result.solid.surfaces[t] == 9) {  // towards the ball's middle: it was cut out
        EXPECT_GT(dot(n, normalize(Point3d{2, 2, 2} - p)), 0.999);
      } else {
        EXPECT_EQ(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1);
      }
    }
}

TEST(Csg, OperandsInsideOrApartNeedNoCut) {
  expect_volume(evaluate(difference({cube(0, 3), cube(1, 2)})), 26, 1e-12);
  expect_volume(evaluate(merge({cube(0, 3), cube(1, 2)})), 27, 1e-12);
  expect_volume(evaluate(intersection({cube(0, 3), cube(1, 2)})), 1, 1e-12);
  expect_volume(evaluate(difference({cube(0, 1), cube(2, 3)})), 1, 1e-12);
  EXPECT_TRUE(evaluate(intersection({cube(0, 1), cube(2, 3)})).solid.empty());
  EXPECT_TRUE(evaluate(difference({cube(1, 2), cube(0, 3)})).solid.empty());
  EXPECT_TRUE(evaluate(difference({cube(0, 1), cube(0, 1)})).solid.empty());
  EXPECT_TRUE(evaluate(intersection({})).solid.empty());
}

TEST(Csg, CoincidentFacesLeaveNoHoles) {
  // The drill ends in the plane of the block's side, and as deep as the block is.
  const auto drill = [] { return solid(cylinder({0, 0, 0}, {0, 2, 0}, 0.5, false), 1); };
  const auto block = [] { return solid(box({-1, 0, -1}, {1, 2, 1}), 0); };
  const CsgResult bored = evaluate(difference({block(), drill()}));
  expect_volume(bored, 8 - pi / 2, 0.01);
  expect_volume(evaluate(merge({block(), drill()})), 8, 1e-9);
  expect_volume(evaluate(merge({cube(0, 1), solid(box({1, 0, 0}, {2, 1, 1}), 1)})), 2, 1e-12);
}

TEST(Csg, TouchingEdgesAndVerticesAreMovedApart) {
  for (const Point3d at : {Point3d{1, 1, 0}, Point3d{1, 1, 1}}) {
    const CsgResult result = evaluate(merge({cube(0, 1), solid(box(at, at + Vector3d{1, 1, 1}), 1)}));
    expect_volume(result, 2, 1e-4);
    EXPECT_EQ(result.perturbation > 0, at.z == 0) << "along an edge";
    EXPECT_LE(result.perturbation, 1e-5);
  }
  // Two holes that meet along an edge.
  const CsgResult cut = evaluate(
      difference({cube(0, 4), solid(box({1, 1, 1}, {2, 2, 2}), 1), solid(box({2, 2, 1}, {3, 3, 2}), 1)}));
  expect_volume(cut, 62, 1e-3);
  EXPECT_GT(cut.perturbation, 0);
  EXPECT_LE(cut.perturbation, 1e-5);
  EXPECT_EQ(evaluate(merge({cube(0, 2), cube(1, 3)})).perturbation, 0);
}

// As far as the cube that stands for infinity, in whichever direction.
TEST(Csg, WhatHasNoEndSaysSo) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      std::vector<Csg> sides;
      for (int other = 0; other < 3; ++other)
        for (const double side : {-1.0, 1.0}) {
          Vector3d n;
          n[other] = side;
          if (other != axis || side != sign) sides.push_back(half_space({n, 1}, 1));
        }
      const CsgResult open = evaluate(intersection(sides), {.reach = 10});
      expect_volume(open, 4 * 11, 1e-9);
      EXPECT_TRUE(open.reaches_infinity) << axis << ' ' << sign;
    }
}

TEST(Csg, HalfSpacesCutWithoutMeshesAtInfinity) {
  const CsgResult half = evaluate(intersection({ball({0, 0, 0}, 1), half_space({{0, 2, 0}, 0.5}, 1)}));
  const double cap = pi * 0.5 * 0.5 * (3 - 0.5) / 3;
  expect_volume(half, 4 * pi / 3 - cap, 0.01);
  EXPECT_FALSE(half.reaches_infinity);
  EXPECT_EQ(mesh_of(half.solid).triangles.size(), half.solid.triangles.size());
  const CsgResult other = evaluate(difference({ball({0, 0, 0}, 1), half_space({{0, 1, 0}, 0.5}, 1)}));
  expect_volume(other, cap, 0.01);
  const CsgResult slanted = evaluate(intersection({cube(-1, 1), half_space({{1, 2, 3}, 0}, 1)}));
  expect_volume(slanted, 4, 1e-9);
  expect_volume(evaluate(intersection({cube(-1, 1), half_space({{1, 2, 3}, 9}, 1)})), 8, 1e-12);
  EXPECT_TRUE(evaluate(intersection({cube(-1, 1), half_space({{1, 2, 3}, -9}, 1)})).solid.empty());
}

TEST(Csg, PlanesAloneMakeAPolyhedron) {
  std::vector<Csg> sides;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Vector3d n;
      n[axis] = sign;
      sides.push_back(half_space({n, 1}, static_cast<std::uint32_t>(sides.size())));
    }
  const CsgResult result = evaluate(intersection(sides));
  expect_volume(result, 8, 1e-9);
  EXPECT_FALSE(result.reaches_infinity);
  EXPECT_EQ(surfaces_of(result.solid).size(), 6u);
  sides.pop_back();
  const CsgResult open = evaluate(intersection(sides), {.reach = 10});
  expect_volume(open, 4 * 11, 1e-9);
  EXPECT_TRUE(open.reaches_infinity);
  EXPECT_EQ(surfaces_of(open.solid).size(), 5u);
}

TEST(Csg, ComplementsObeyDeMorgan) {
  // a − (b ∪ ¬c) = a ∩ ¬b ∩ c.
  const CsgResult result = evaluate(
      difference({cube(0, 4), unite({cube(0, 2), complement(solid(box({0, 0, 0}, {4, 4, 2}), 1))})}));
  expect_volume(result, 4 * 4 * 2 - 8, 1e-9);
  const CsgResult twice = evaluate(intersection({cube(0, 4), complement(complement(cube(0, 2)))}));
  expect_volume(twice, 8, 1e-9);
  // The complement of a ball alone has the ball's surface, seen from within.
  EXPECT_NEAR(volume(evaluate(complement(ball({0, 0, 0}, 1))).solid), -4 * pi / 3, 0.02);
  // Two half spaces, the sum of which is what is not in the quarter.
  const CsgResult wide = evaluate(
      intersection({cube(-1, 1), unite({half_space({{1, 0, 0}, 0}, 1), half_space({{0, 1, 0}, 0}, 2)})}));
  expect_volume(wide, 6, 1e-9);
}

TEST(Csg, CutSurfacesStayOpen) {
  const CsgResult bowl = evaluate(cut_surfaces(ball({0, 0, 0}, 1, 3), {half_space({{0, 1, 0}, 0}, 5)}));
  EXPECT_TRUE(bowl.refused.empty());
  EXPECT_FALSE(bowl.solid.closed);
  EXPECT_EQ(surfaces_of(bowl.solid), (std::vector<std::uint32_t>{3}));
  double area = 0;
  for (const auto& t : bowl.solid.triangles) {
    const auto p = [&](std::size_t i) { return bowl.solid.positions[t[i]]; };
    area += length(cross(p(1) - p(0), p(2) - p(0))) / 2;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(p(i).y, 1e-12);
  }
  EXPECT_NEAR(area, 2 * pi, 0.02);
  // A disc outside of a box: three quarters of it.
  const CsgResult rest = evaluate(cut_surfaces(solid(disc({0, 0, 0}, {0, 1, 0}, 1, 0), 3),
                                               {complement(solid(box({0, -1, 0}, {2, 1, 2}), 5))}));
  area = 0;
  for (const auto& t : rest.solid.triangles) {
    const auto p = [&](std::size_t i) { return rest.solid.positions[t[i]]; };
    area += length(cross(p(1) - p(0), p(2) - p(0))) / 2;
  }
  EXPECT_NEAR(area, 0.75 * pi, 0.01);
}

TEST(Csg, ManyHolesAndManyBodies) {
  std::vector<Csg> plate{solid(box({0, 0, 0}, {10, 1, 5}), 0)}, balls;
  for (int i = 0; i < 50; ++i) {
    const double x = 0.5 + i % 10, z = 0.5 + i / 10;
    plate.push_back(solid(cylinder({x, -1, z}, {x, 2, z}, 0.3, false), 1));
    balls.push_back(ball({0.7 * i, 0, 0}, 0.5, 0, 1e-2));
  }
  expect_volume(evaluate(difference(plate)), 50 * (1 - pi * 0.09), 0.1);
  const double lens = pi * (4 * 0.5 + 0.7) * (2 * 0.5 - 0.7) * (2 * 0.5 - 0.7) / 12;  // of two neighbours
  expect_volume(evaluate(merge(balls)), 50 * pi / 6 - 49 * lens, 1.5);
}

TEST(Csg, OverlappingHolesAreCutOneAfterTheOther) {
  std::vector<Csg> operands{cube(-2, 2, 0)};
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * pi * i / 12;
    operands.push_back(ball({1.7 * std::cos(angle), 1.7 * std::sin(angle), 2}, 0.6, 1));
  }
  const CsgResult result = evaluate(difference(operands));
  EXPECT_TRUE(result.refused.empty());
  EXPECT_TRUE(is_watertight(result.solid));
  // Against points at random: inside of the cube and of no ball.
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  constexpr int count = 200000;
  int in = 0;
  for (int i = 0; i < count; ++i) {
    const Point3d p{4 * random() - 2, 4 * random() - 2, 4 * random() - 2};
    bool cut = false;
    for (int k = 0; k < 12; ++k) {
      const double angle = 2 * pi * k / 12;
      cut = cut || length(p - Point3d{1.7 * std::cos(angle), 1.7 * std::sin(angle), 2}) < 0.6;
    }
    in += !cut;
  }
  EXPECT_NEAR(volume(result.solid), 64.0 * in / count, 0.2);
}

TEST(Csg, TransformsReachHalfSpacesToo) {
  Csg half = intersection({ball({0, 0, 0}, 1), half_space({{0, 1, 0}, 0}, 1)});
  const CsgResult moved =
      evaluate(transformed(half, translate({5, 6, 7}) * scale({-2, 2, 2}) * rotate(1, {1, 2, 3})));
  expect_volume(moved, 8 * 2 * pi / 3, 0.1);
}

TEST(Csg, OperandsThatIntersectThemselvesAreRefusedOrRight) {
  // Two boxes that overlap, as one body: their triangles share a vertex by a bridge of none.
  Solid both = box({0, 0, 0}, {2, 2, 2});
  append(both, box({1, 1, 1}, {3, 3, 3}));
  const CsgResult result = evaluate(difference({solid(both, 0), cube(1.5, 2.5, 1)}));
  // They are taken for two bodies, each of which is cut.
  EXPECT_TRUE(result.refused.empty());
  EXPECT_NEAR(volume(result.solid), 8 - 0.125 + 8 - 1, 1e-9);
  // Bodies that belong together and intersect are refused where that is met.
  Solid hollow = box({0, 0, 0}, {4, 4, 4});
  append(hollow, inverted(box({3, 3, 3}, {5, 5, 5})));
  const CsgResult bad = evaluate(difference({solid(hollow, 0), cube(2.5, 4.5, 1)}));
  ASSERT_EQ(bad.refused.size(), 1u);
  EXPECT_EQ(bad.refused.front(), "difference: an operand intersects itself");
  EXPECT_EQ(bad.solid.triangles.size(), 24u);
}

}  // namespace
}  // namespace vitrail::solids::csg_test
