// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/implicit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "importers/solids/csg.h"
#include "importers/solids/fractal.h"
#include "importers/solids/primitives.h"
#include "scene/geometry/pi.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/solids/solid_checks.h"

namespace vitrail::solids::implicit_test {
namespace {

double from_origin(Point3d p) { return length(p - Point3d{}); }

// Triangles that the container does not make.
Solid without_caps(Solid solid, const auto& is_cap) {
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto p = [&](std::size_t i) { return solid.positions[solid.triangles[t][i]]; };
    if (is_cap(p(0)) && is_cap(p(1)) && is_cap(p(2))) solid.surfaces[t] = unseen;
  }
  return solid;
}

TEST(Implicit, BallIsWithinItsDeviation) {
  for (const double gradient : {0.0, 1.0}) {
    const Solid made =
        implicit({.field = [](const Point3d& p) { return from_origin(p) - 0.8; }, .max_gradient = gradient});
    expect_sound(made, 0.5);
    EXPECT_LT(greatest_distance(made, [](Point3d p) { return from_origin(p) - 0.8; }), 5e-4 * 1.6);
    EXPECT_NEAR(volume(made), 4 * pi / 3 * 0.512, 3e-3);
  }
}

TEST(Implicit, ContainersCloseWhatTheyCut) {
  const Field ball = [](const Point3d& p) { return from_origin(p) - 1.1; };
  const Solid in_box = implicit({.field = ball});
  expect_sound(in_box, -0.1);
  const double cap = pi * 0.01 * (3.3 - 0.1) / 3;
  EXPECT_NEAR(volume(in_box), 4 * pi / 3 * 1.331 - 6 * cap, 0.02);
  const auto at_side = [](Point3d p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 1 - 1e-12;
  };
  EXPECT_LT(greatest_distance(without_caps(in_box, at_side), [](Point3d p) { return from_origin(p) - 1.1; }),
            5e-4 * 2);
  const Solid open = implicit({.field = ball, .open = true});
  expect_sound(open, -0.1);
  EXPECT_LT(mesh_of(open).triangles.size(), open.triangles.size());
  // Half of the containing ball.
  const Solid half = implicit(
      {.field = [](const Point3d& p) { return p.y - 0.123; }, .container = ContainingSphere{{0, 0, 0}, 1}});
  expect_sound(half, -0.1);
  const double segment = pi * 0.877 * 0.877 * (3 - 0.877) / 3;
  EXPECT_NEAR(volume(half), 4 * pi / 3 - segment, 0.01);
  EXPECT_LT(greatest_distance(half, [](Point3d p) { return std::max(from_origin(p) - 1, p.y - 0.123); }),
            1e-3 * 1.2);
  // All of the container.
  EXPECT_NEAR(volume(implicit({.field = [](const Point3d&) { return -1; }})), 8, 1e-12);
  EXPECT_TRUE(implicit({.field = [](const Point3d&) { return NAN; }}).empty());
}

TEST(Implicit, JumpsAndCreasesAreClosedToo) {
  const Solid steps = implicit({.field = [](const Point3d& p) { return p.y - std::floor(3 * p.x) / 5; }});
  expect_sound(steps, -1.01);
  EXPECT_NEAR(volume(steps), 4 + 4 * (-3 - 2 - 1 + 0 + 1 + 2) / 5.0 / 6, 0.05);
  const Solid octahedron = implicit(
      {.field = [](const Point3d& p) { return std::abs(p.x) + std::abs(p.y) + std::abs(p.z) - 0.9; }});
  expect_sound(octahedron, -1.01);
  EXPECT_NEAR(volume(octahedron), 4.0 / 3 * 0.729, 0.01);
}

TEST(Implicit, PolynomialsTakePovRaysOrder) {
  // x² + 2y² + 3z² − 1, as a quadric and as a quartic.
  const double quadric[10] = {1, 2, 3, 0, 0, 0, 0, 0, 0, -1};
  const Field two = polynomial(2, quadric_coefficients(quadric));
  EXPECT_NEAR(two({0.5, 0.25, 0.125}), 0.25 + 0.125 + 3.0 / 64 - 1, 1e-15);
  const double mixed[10] = {0, 0, 0, 1, 10, 100, 1000, 1e4, 1e5, 1e6};
  EXPECT_NEAR(polynomial(2, quadric_coefficients(mixed))({2, 3, 5}),
              6 + 10 * 10 + 100 * 15 + 2000 + 3e4 + 5e5 + 1e6, 1e-6);
  // Each term of a quartic: the order is that of descending powers of x, then y, then z.
  std::size_t next = 0;
  for (int i = 4; i >= 0; --i)
    for (int j = 4 - i; j >= 0; --j)
      for (int k = 4 - i - j; k >= 0; --k) {
        std::vector<double> one(35);
        one[next++] = 7;
        EXPECT_DOUBLE_EQ(polynomial(4, one)({2, 3, 5}), 7 * std::pow(2, i) * std::pow(3, j) * std::pow(5, k));
      }
  EXPECT_EQ(next, 35u);
  EXPECT_THROW(polynomial(4, std::vector<double>(34)), Error);
}

TEST(Implicit, CutsWithOtherSolids) {
  const Csg unlimited = unbounded(
      [](const Bounds3d& box) {
        return implicit({.field = [](const Point3d& p) { return p.x * p.x + p.z * p.z - 0.25; },
                         .container = box,
                         .open = true});
      },
      1);
  const CsgResult bored = evaluate(difference({solid(box({-1, -1, -1}, {1, 1, 1}), 0), unlimited}));
  EXPECT_TRUE(bored.refused.empty()) << bored.refused.front();
  EXPECT_TRUE(is_watertight(bored.solid));
  EXPECT_NEAR(volume(bored.solid), 8 - 2 * pi / 4, 0.02);
}

TEST(Blob, OneComponentIsABall) {
  // 2 (1 − r²)² = 0.5 at r = √½.
  Blob one{.components = {{.radius = 1, .strength = 2}}, .threshold = 0.5};
  const Solid made = blob(one);
  expect_sound(made, 0.5);
  EXPECT_LT(greatest_distance(made, [](Point3d p) { return from_origin(p) - std::sqrt(0.5); }), 5e-4 * 1.5);
  one.components[0].to_blob = translate({5, 0, 0}) * scale({2, 1, 1});
  EXPECT_NEAR(volume(blob(one)), 2 * volume(made), 0.02);
  EXPECT_NEAR(bounds_of(blob(one)).upper.x, 5 + 2 * std::sqrt(0.5), 0.01);
}

TEST(Blob, ComponentsAddAndSubtract) {
  const auto density = [](Point3d p, Point3d at, double r) {
    const double d = 1 - dot(p - at, p - at) / (r * r);
    return d > 0 ? d * d : 0;
  };
  Blob two{.components = {{{-0.5, 0, 0}, {-0.5, 0, 0}, 1, 1},
                          {{0.5, 0, 0}, {0.5, 0, 0}, 1, 1},
                          {{0, 0.6, 0}, {0, 0.6, 0}, 0.8, -1}},
           .threshold = 0.3};
  const Solid made = blob(two);
  expect_sound(made, 0.2);
  for (const Point3d& p : made.positions)
    EXPECT_NEAR(density(p, {-0.5, 0, 0}, 1) + density(p, {0.5, 0, 0}, 1) - density(p, {0, 0.6, 0}, 0.8), 0.3,
                2e-3);
  // A cylinder with half balls at its ends.
  const Solid capsule = blob({.components = {{{0, 0, 0}, {0, 3, 0}, 1, 2}}, .threshold = 0.5});
  const double r = std::sqrt(0.5);
  EXPECT_NEAR(volume(capsule), pi * r * r * 3 + 4 * pi / 3 * r * r * r, 0.05);
  EXPECT_TRUE(blob({.components = {{.radius = 1, .strength = 0.2}}, .threshold = 0.5}).empty());
}

TEST(SphereSweep, LinesMakeRoundCones) {
  const Solid capsule = sphere_sweep({.spheres = {{{0, 0, 0}, 0.5}, {{0, 4, 0}, 0.5}}});
  expect_sound(capsule, 0.3);
  EXPECT_NEAR(volume(capsule), pi * 0.25 * 4 + 4 * pi / 3 * 0.125, 0.02);
  const Solid bent = sphere_sweep({.spheres = {{{0, 0, 0}, 1}, {{3, 0, 0}, 0.3}, {{3, 3, 0}, 0.3}}});
  expect_sound(bent, -1.01);
  const Bounds3d b = bounds_of(bent);
  EXPECT_NEAR(b.lower.x, -1, 5e-3);
  EXPECT_NEAR(b.upper.x, 3.3, 5e-3);
  EXPECT_NEAR(b.upper.y, 3.3, 5e-3);
  EXPECT_THROW(sphere_sweep({.spheres = {{{0, 0, 0}, 1}}}), Error);
}

TEST(SphereSweep, SplinesPassBetweenTheirInnerSpheres) {
  SphereSweep sweep{.kind = SweepKind::cubic};
  for (int i = -1; i <= 9; ++i)
    sweep.spheres.push_back({{std::cos(pi / 4 * i), 0, std::sin(pi / 4 * i)}, 0.2});
  const Solid ring = sphere_sweep(sweep);
  expect_sound(ring, 0.2);
  EXPECT_NEAR(volume(ring), 2 * pi * pi * 0.04, 0.02);
}

TEST(JuliaFractal, ZeroIsABall) {
  // h ← h² stays below 4 for n steps where |h| < 4^(1/2ⁿ).
  const Solid made = julia_fractal({.max_iteration = 2});
  expect_sound(made, 0.3);
  EXPECT_LT(greatest_distance(made, [](Point3d p) { return from_origin(p) - std::sqrt(2.0); }), 5e-4 * 3);
  for (const bool hypercomplex : {false, true}) {
    const Solid twisted = julia_fractal(
        {.parameter = {-0.083, 0, -0.83, -0.025}, .hypercomplex = hypercomplex, .max_iteration = 6});
    expect_sound(twisted, -1.01);
    EXPECT_LT(bounds_of(twisted).upper.x, 1.9);
  }
  EXPECT_THROW(julia_fractal({.slice_normal = {1, 0, 0, 0}}), Error);
}

// Of h ← h² from (x,0,0,0), |h| is x⁴ after two steps. povray 3.7 shows this one 1.41 wide at
// max_iteration 3.
TEST(JuliaFractal, HypercomplexNumbersTakeOneStepLess) {
  const Solid made = julia_fractal({.hypercomplex = true, .max_iteration = 3});
  EXPECT_NEAR(bounds_of(made).upper.x, std::sqrt(2.0), 5e-3);
}

}  // namespace
}  // namespace vitrail::solids::implicit_test
