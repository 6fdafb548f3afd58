// SPDX-License-Identifier: Apache-2.0
// Curves: what is kept of a segment, where it goes under a transform, and the triangles that stand for
// curves.
#include "scene/shapes/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/geometry/pi.h"
#include "scene/shapes/curve_meshes.h"

namespace vitrail::curve_test {
namespace {

const CurveSegment bow{{{{1, 2, 3}, 0.5}, {{2, 2, 4}, 0.25}, {{3, 1, 4}, 0.125}, {{3, 0, 2}, 1}}};

void expect_near(Point3d a, Point3d b, double tolerance) { EXPECT_LT(length(a - b), tolerance); }

TEST(PlacedCurves, ComeBackFromTheirPlaces) {
  for (const bool straight : {false, true}) {
    PlacedCurve c = placed_curve(bow, 0.25, 0.75, straight);
    c.mirrored = !straight;
    const Transform place = packed(c);
    double rows[3][4];
    for (std::size_t i = 0; i < 3; ++i) std::ranges::copy(place.m[i], rows[i]);
    for (const PlacedCurve& back : {unpacked_curve(place), unpacked_curve(rows)}) {
      EXPECT_EQ(back.origin, bow[0].position);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(cast<double>(back.to[i]), bow[i + 1].position - bow[0].position);
      EXPECT_EQ(back.radius, (std::array{0.5f, 0.25f, 0.125f, 1.0f}));
      EXPECT_EQ(back.along_first, 0.25f);
      EXPECT_EQ(back.along_last, 0.75f);
      EXPECT_EQ(back.straight, straight);
      EXPECT_EQ(back.mirrored, !straight);
    }
  }
}

TEST(PlacedCurves, GoWhereTheirPointsGo) {
  const PlacedCurve c = placed_curve(bow, 0, 1, false);
  const Transform turn = translate({1, 2, 3}) * rotate(0.7, {1, 2, 3});
  for (const double side : {1.0, -1.0}) {
    const Transform t = turn * scale({2, 2, 2 * side});
    EXPECT_TRUE(is_similarity(t));
    const PlacedCurve moved = transformed(t, c);
    EXPECT_EQ(moved.mirrored, side < 0);
    const CurveSegment s = segment_of(moved);
    for (std::size_t i = 0; i < 4; ++i) {
      expect_near(s[i].position, transform_point(t, bow[i].position), 1e-5);
      EXPECT_NEAR(s[i].radius, 2 * bow[i].radius, 1e-6);
    }
  }
  EXPECT_FALSE(is_similarity(turn * scale({2, 2, 2.01})));
}

TEST(PlacedCurves, BoundsHoldTheirPointsByTheGreatestRadius) {
  const Bounds3d box = bounds_of(placed_curve(bow, 0, 1, false));
  EXPECT_EQ(box.lower, (Point3d{0, -1, 1}));
  EXPECT_EQ(box.upper, (Point3d{4, 3, 5}));
  const PlacedCurve line = placed_curve(bow, 0, 1, true);
  EXPECT_EQ(bounds_of(line).upper, (Point3d{4, 3, 4})) << "from its first point to its last";
  expect_near(segment_of(line)[1].position, mix(bow[0], bow[3], 1.0 / 3).position, 1e-6);
  expect_near(segment_of(line)[2].position, mix(bow[0], bow[3], 2.0 / 3).position, 1e-6);
}

TEST(PlacedCurves, ShareOutTheirParameter) {
  const std::vector<CurvePoint> points{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{1, 1, 0}, 1}};
  const auto curves = placed_curves(linear_segments(points), 0.5, 1, true, true);
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(curves[0].along_first, 0.5f);
  EXPECT_EQ(curves[0].along_last, 0.75f);
  EXPECT_EQ(curves[1].along_last, 1.0f);
  // Both ends are round; the plane between halves the angle.
  EXPECT_EQ(curves[0].to[0], (Vector3f{0, 0, 0}));
  EXPECT_EQ(curves[0].to[2] - curves[0].to[1], (Vector3f{1, 1, 0}));
  EXPECT_EQ(curves[1].to[0], (Vector3f{1, 1, 0}));
  EXPECT_EQ(curves[1].to[2], curves[1].to[1]);
}

TEST(Bsplines, AreSmoothWhereSegmentsMeet) {
  const std::vector<CurvePoint> points{
      {{0, 0, 0}, 1}, {{1, 2, 0}, 2}, {{3, 2, 1}, 1}, {{4, 0, 0}, 3}, {{5, 1, 7}, 2}};
  const auto s = bspline_segments(points);
  ASSERT_EQ(s.size(), 2u);
  expect_near(s[0][3].position, s[1][0].position, 1e-12);
  expect_near(s[0][3].position + (s[0][3].position - s[0][2].position), s[1][1].position, 1e-12);
  EXPECT_NEAR(2 * s[0][3].radius - s[0][2].radius, s[1][1].radius, 1e-12);
}

// From the origin along x to 4, of radius 1 at first.
TriangleMesh tube(double last_radius, bool round_ends) {
  const std::vector<CurvePoint> points{{{0, 0, 0}, 1}, {{4, 0, 0}, last_radius}};
  TriangleMesh mesh;
  append_tube(linear_segments(points), {2, 8}, 0.25, 0.75, round_ends, mesh);
  return mesh;
}

// As far from the axis as corners are from the circle of their circumference.
const double to_corner = pi / 8 / std::sin(pi / 8);

TEST(Tubes, OfStraightCurvesAreCylindersAndCones) {
  for (const double last : {1.0, 3.0}) {
    const double slope = (last - 1) / 4;
    const TriangleMesh mesh = tube(last, false);
    ASSERT_EQ(mesh.positions.size(), 27u);  // three rings of eight corners and the first again
    ASSERT_EQ(mesh.triangles.size(), 32u);
    for (const auto& [a, b, c] : mesh.triangles) {
      const Normal3f n = mesh.normals[a];
      const Vector3f across =
          cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
      EXPECT_GT(across.x * n.x + across.y * n.y + across.z * n.z, 0) << "the front is outside";
    }
    for (std::size_t i = 0; i < 27; ++i) {
      const Point3d p = cast<double>(mesh.positions[i]);
      const Normal3f n = mesh.normals[i];
      const double distance = std::hypot(p.y, p.z);
      EXPECT_NEAR(p.x, 2.0 * static_cast<double>(i / 9), 1e-6);
      EXPECT_NEAR(distance, (1 + slope * p.x) * to_corner, 1e-6);
      EXPECT_NEAR(n.x, -slope / std::hypot(1, slope), 1e-6);
      EXPECT_NEAR(n.y * p.y + n.z * p.z, distance / std::hypot(1, slope), 1e-6);
      EXPECT_EQ(mesh.uvs[i],
                (Point2f{static_cast<float>(i % 9) / 8, 0.25f + 0.25f * static_cast<float>(i / 9)}));
    }
  }
}

TEST(Tubes, RoundEndsAreHalfSpheres) {
  const TriangleMesh mesh = tube(1, true);
  ASSERT_EQ(mesh.positions.size(), 11u * 9);  // four rings more at either end
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Point3d p = cast<double>(mesh.positions[i]);
    const double off = p.x - std::clamp(p.x, 0.0, 4.0);
    EXPECT_NEAR(std::hypot(off, std::hypot(p.y, p.z) / to_corner), 1, 1e-6);
    const Normal3f n = mesh.normals[i];
    EXPECT_NEAR(n.x, off, 1e-6);
    EXPECT_NEAR(std::hypot(n.x, n.y, n.z), 1, 1e-6);
  }
  EXPECT_NEAR(mesh.positions.front().x, -1, 1e-6);
  EXPECT_NEAR(mesh.positions[9].x, -std::cos(pi / 8), 1e-6);
  EXPECT_NEAR(mesh.positions.back().x, 5, 1e-6);
}

// In a plane an edge along a tube keeps its angle to it, but for what so many steps leave.
TEST(Tubes, DoNotTwist) {
  const Vector3d u = normalize(Vector3d{1, -1, 0}), v = normalize(Vector3d{1, 1, -2}),
                 n = normalize(cross(u, v));
  const auto at = [&](double x, double y) { return CurvePoint{Point3d{} + u * x + v * y, 0.1}; };
  TriangleMesh mesh;
  append_tube(std::vector<CurveSegment>{{at(0, 0), at(2, 0), at(2, 2), at(-1, 2)}}, {64, 8}, 0, 1, false,
              mesh);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const Normal3f a = mesh.normals[i], b = mesh.normals[i % 9];
    EXPECT_NEAR(a.x * n.x + a.y * n.y + a.z * n.z, b.x * n.x + b.y * n.y + b.z * n.z, 0.02) << i;
  }
}

TEST(Ribbons, RunAlongUAndAcrossV) {
  const std::vector<CurvePoint> points{{{0, 0, 0}, 1}, {{4, 0, 0}, 1}};
  TriangleMesh mesh;
  append_ribbon(linear_segments(points), std::vector<Vector3d>(2, {0, 0, 1}), 2, mesh);
  EXPECT_EQ(mesh.positions,
            (std::vector<Point3f>{{0, -1, 0}, {0, 1, 0}, {2, -1, 0}, {2, 1, 0}, {4, -1, 0}, {4, 1, 0}}));
  EXPECT_EQ(mesh.uvs, (std::vector<Point2f>{{0, 0}, {0, 1}, {.5f, 0}, {.5f, 1}, {1, 0}, {1, 1}}));
}

}  // namespace
}  // namespace vitrail::curve_test
