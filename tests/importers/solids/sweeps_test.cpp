// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/sweeps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "importers/solids/bodies.h"
#include "scene/geometry/pi.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/solids/solid_checks.h"

namespace vitrail::solids::sweeps_test {
namespace {

std::vector<Point2d> square(double half) {
  return {{-half, -half}, {half, -half}, {half, half}, {-half, half}, {-half, -half}};
}

void add(std::vector<Point2d>& points, const std::vector<Point2d>& more) {
  points.insert(points.end(), more.begin(), more.end());
}

// A circle of four Bézier segments, within 3e-4 of its radius.
std::vector<Point2d> bezier_circle(Point2d middle, double r) {
  constexpr double k = 0.5522847498;
  std::vector<Point2d> points;
  Point2d a{1, 0};
  for (int i = 0; i < 4; ++i) {
    const Point2d b{-a.y, a.x};
    for (const Point2d p :
         {a, Point2d{a.x + k * b.x, a.y + k * b.y}, Point2d{b.x + k * a.x, b.y + k * a.y}, b})
      points.push_back({middle.x + r * p.x, middle.y + r * p.y});
    a = b;
  }
  return points;
}

TEST(Prism, ContoursInContoursAreHoles) {
  Prism p{.height1 = 1, .height2 = 3, .points = square(2)};
  add(p.points, square(1));
  add(p.points, square(0.5));
  const Solid made = prism(p);
  expect_sound(made, 0.999);
  EXPECT_NEAR(volume(made), 2 * (16 - 4 + 1), 1e-12);
  EXPECT_EQ(bounds_of(made), (Bounds3d{{-2, 1, -2}, {2, 3, 2}}));
  p.open = true;
  EXPECT_EQ(mesh_of(prism(p)).triangles.size(), 3u * 8);
}

TEST(Prism, ContoursThatCrossThemselvesAreClosed) {
  const Solid star =
      prism({.points = {{0, 1}, {0.6, -0.8}, {-0.95, 0.3}, {0.95, 0.3}, {-0.6, -0.8}, {0, 1}}});
  expect_sound(star, 0.99);
  const Solid two =
      prism({.points = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {1, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 1}}});
  expect_sound(two, 0.99);
  EXPECT_NEAR(volume(two), 3 + 3, 1e-12);  // what both cover is a hole
}

TEST(Prism, ConesHaveTheirApexAtTheOrigin) {
  Prism p{.conic = true, .height1 = 0, .height2 = 1, .points = square(1)};
  expect_sound(prism(p), 0.99);
  EXPECT_NEAR(volume(prism(p)), 4.0 / 3, 1e-12);
  p.height1 = 0.5;
  expect_sound(prism(p), 0.99);
  EXPECT_NEAR(volume(prism(p)), 4.0 / 3 * (1 - 0.125), 1e-12);
  p.height1 = -2;
  expect_sound(prism(p), 0.99);
  EXPECT_NEAR(volume(prism(p)), 4.0 / 3 * (1 + 8), 1e-12);
  p.points = bezier_circle({0, 0}, 1);
  p.spline = SplineKind::bezier;
  const Solid cone = prism(p);
  expect_sound(cone, 0.9);
  const double slope = std::sqrt(0.5);
  for (std::size_t t = 0; t < cone.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      if (const Normal3f n = cone.normals[t][i]; std::abs(n.y) < 0.9f) {
        EXPECT_NEAR(std::abs(n.y), slope, 1e-3);
      }
}

TEST(Prism, SplinesPassThroughTheirPoints) {
  Prism p{.spline = SplineKind::bezier, .points = bezier_circle({1, 2}, 2)};
  expect_sound(prism(p), 0.95);
  EXPECT_LT(
      greatest_distance(prism(p), [](Point3d q) { return std::max(0.0, std::hypot(q.x - 1, q.z - 2) - 2); }),
      3e-3);
  EXPECT_NEAR(volume(prism(p)), 4 * pi, 0.02);
  for (const SplineKind kind : {SplineKind::quadratic, SplineKind::cubic}) {
    Prism q{.spline = kind};
    for (int i = -1; i <= 17; ++i) q.points.push_back({std::cos(pi / 8 * i), std::sin(pi / 8 * i)});
    q.points[17] = q.points[1];
    if (kind == SplineKind::quadratic) q.points.pop_back();
    expect_sound(prism(q), 0.9);
    EXPECT_NEAR(volume(prism(q)), pi, 0.02);
  }
}

TEST(Prism, TooFewPointsAreAnError) {
  EXPECT_THROW(prism({.points = {{0, 0}, {1, 1}}}), Error);
  EXPECT_THROW(prism({.height1 = 1, .height2 = 1, .points = square(1)}), Error);
  EXPECT_THROW(prism({.points = {{0, 0}, {1, 0}, {NAN, 1}, {0, 0}}}), Error);
  EXPECT_THROW(lathe({.spline = SplineKind::cubic, .points = {{0, 0}, {1, 1}, {2, 2}}}), Error);
}

TEST(Lathe, LinesMakeCones) {
  // Both ways along the curve.
  for (const auto& points :
       {std::vector<Point2d>{{0, 0}, {2, 0}, {1, 3}, {0, 3}}, {{0, 3}, {1, 3}, {2, 0}, {0, 0}}}) {
    const Solid made = lathe({.points = points});
    expect_sound(made, 0.99);
    EXPECT_NEAR(volume(made), pi * 3 / 3 * (4 + 2 + 1), 0.05);
    EXPECT_EQ(mesh_of(made).triangles.size(), made.triangles.size());
  }
}

TEST(Lathe, EndsOffTheAxisAreClosedUnseen) {
  const Solid made = lathe({.points = {{2, 0}, {1, 3}}});
  expect_sound(made, 0.99);
  EXPECT_NEAR(volume(made), pi * 3 / 3 * (4 + 2 + 1), 0.05);
  EXPECT_EQ(mesh_of(made).triangles.size() * 2, made.triangles.size());
}

TEST(Lathe, ClosedCurvesMakeRings) {
  const Solid made = lathe({.spline = SplineKind::bezier, .points = bezier_circle({3, 1}, 1)});
  expect_sound(made, 0.95);
  EXPECT_NEAR(volume(made), 2 * pi * pi * 3, 0.2);
  EXPECT_LT(
      greatest_distance(made, [](Point3d p) { return std::hypot(std::hypot(p.x, p.z) - 3, p.y - 1) - 1; }),
      5e-4 * 8 + 3e-4);
  const Solid fine = lathe({.spline = SplineKind::bezier, .points = bezier_circle({3, 1}, 1)}, {5e-5});
  EXPECT_GT(fine.triangles.size(), 100000u);
}

// r² is 1 + y − y²/4 where its points and slopes say so.
TEST(SurfaceOfRevolution, SquaresOfRadiiAreCubics) {
  SurfaceOfRevolution sor;
  for (int i = 0; i < 8; ++i) sor.points.push_back({1 + 0.5 * std::sin(i), 0.5 * i});
  const Solid made = surface_of_revolution(sor);
  expect_sound(made, 0.9);
  // The points are on it.
  for (std::size_t i = 1; i + 1 < sor.points.size(); ++i) {
    const Point2d p = sor.points[i];
    double near = 1;
    for (const Point3d& q : made.positions)
      near = std::min(near, std::hypot(std::hypot(q.x, q.z) - p.x, q.y - p.y));
    EXPECT_LT(near, 1e-9);
  }
  // π ∫ r² dy of each cubic by its ends and slopes.
  double expected = 0;
  for (std::size_t i = 1; i + 2 < sor.points.size(); ++i) {
    const auto &a = sor.points[i - 1], &b = sor.points[i], &c = sor.points[i + 1], &d = sor.points[i + 2];
    const double h = c.y - b.y;
    const double from = 2 * b.x * (c.x - a.x) / (c.y - a.y), to = 2 * c.x * (d.x - b.x) / (d.y - b.y);
    expected += pi * (h * (b.x * b.x + c.x * c.x) / 2 + h * h * (from - to) / 12);
  }
  EXPECT_NEAR(volume(made), expected, 0.01 * expected);
  EXPECT_GT(volume(made), 0.995 * expected);
  sor.open = true;
  EXPECT_LT(mesh_of(surface_of_revolution(sor)).triangles.size(), made.triangles.size());
  sor.points[3].y = 0;
  EXPECT_THROW(surface_of_revolution(sor), Error);
}

constexpr const char* roman = "/usr/share/fonts/truetype/povray/timrom.ttf";

TEST(Text, LettersAreClosedAndHaveTheirHoles) {
  const Solid made = text({.font_file = roman, .utf8 = "O", .thickness = 0.5});
  expect_sound(made, 0.9);
  const Vector3d size = extent(bounds_of(made));
  EXPECT_NEAR(size.z, 0.5, 1e-12);
  EXPECT_GT(size.y, 0.5);
  EXPECT_LT(size.y, 0.9);
  EXPECT_LT(volume(made), 0.5 * 0.5 * size.x * size.y);  // a ring
  // Euler's characteristic of a torus is 0.
  EXPECT_EQ(made.positions.size() * 2, made.triangles.size());
}

TEST(Text, LettersFollowEachOther) {
  const auto width = [](const char* word, double gap = 0) {
    return bounds_of(text({roman, word, 1, {gap, 0, 0}})).upper.x;
  };
  EXPECT_GT(width("ii"), 1.5 * width("i"));
  EXPECT_NEAR(width("ii", 0.25), width("ii") + 0.25, 1e-12);
  EXPECT_LT(width("AV"), width("A") + width("V"));
  const Solid word = text({.font_file = roman, .utf8 = "Vitrail"});
  expect_sound(word, 0.9);
  EXPECT_TRUE(text({roman, "", 1, {}}).empty());
  EXPECT_TRUE(text({roman, " \xff", 1, {}}).closed);
  EXPECT_THROW(text({"/dev/null", "a", 1, {}}), Error);
}

}  // namespace
}  // namespace vitrail::solids::sweeps_test
