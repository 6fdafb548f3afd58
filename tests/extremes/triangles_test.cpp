// SPDX-License-Identifier: Apache-2.0
// Needles and giants: what is hit and where, against CGAL's exact kernel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/extremes/measure.h"
#include "tests/laws/exact/exact_oracle.h"
#include "tests/laws/exact/soup.h"

namespace vitrail::test::triangles_test {
namespace {

Point3f rounded(Point3d p) { return cast<float>(p); }

// Triangles of that length and width, anywhere in [−1, 1]³ and turned anyhow.
Triangles needles(SoupRandom& random, std::size_t count, double length, double width) {
  Triangles triangles;
  while (triangles.size() < count) {
    const Point3d a = Point3d{} + random.vector(1);
    const Vector3d along = normalize(random.vector(1)), aside = normalize(cross(along, random.vector(1)));
    const Triangle t{rounded(a), rounded(a + along * length),
                     rounded(a + along * (length * random.unit()) + aside * width)};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  return triangles;
}

// Aimed at a point inside of one of them, from anywhere about.
Ray ray_at(const Triangles& triangles, SoupRandom& random) {
  const Triangle& t = triangles[random.below(triangles.size())];
  double u = random.unit(), v = random.unit();
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const auto a = cast<double>(t[0]);
  const Point3d target = a + (cast<double>(t[1]) - a) * u + (cast<double>(t[2]) - a) * v;
  const Point3f origin = rounded(Point3d{} + random.vector(1.5));
  return {origin, cast<float>(target - cast<double>(origin)), no_triangle};
}

struct Judgement {
  std::size_t rays = 0, wrong = 0, refused = 0;
  double distance = 0;  // greatest of |Δt|·|d| over the greatest coordinate
};

bool exactly_hit(const Triangles& triangles, const Ray& ray, std::uint32_t triangle) {
  const ClusteredTriangles alone = cluster({triangles[triangle]});
  return brute_force(view_of(alone), ray).triangle != no_triangle;
}

// Against the nearest crossing of all. A needle that is too narrow, as the ray sees it, for its distance to
// be known is refused: docs/why/exact-intersection.md says when.
Judgement judge(const Triangles& triangles, SoupRandom& random, std::size_t rays) {
  const ExactOracle oracle(triangles);
  const ClusteredTriangles clustered = cluster(triangles);
  const auto size = static_cast<double>(greatest_coordinate(triangles));
  Judgement result;
  while (result.rays < rays) {
    const Ray ray = ray_at(triangles, random);
    const auto crossings = oracle.crossings(ray);
    if (!crossings) continue;
    ++result.rays;
    ExactCrossing nearest{no_triangle, HUGE_VAL, 0, 0};
    for (const ExactCrossing& c : *crossings)
      if (c.t > 0 && c.t < nearest.t) nearest = c;
    Hit hit;
    best_kernel().closest(view_of(clustered), prepare(ray), hit);
    if (hit.triangle != nearest.triangle) {
      const bool refused = nearest.triangle != no_triangle && !exactly_hit(triangles, ray, nearest.triangle);
      ++(refused ? result.refused : result.wrong);
    } else if (hit.triangle != no_triangle) {
      const double error = std::abs(hit.t - nearest.t) * length(cast<double>(ray.direction)) / size;
      result.distance = std::max(result.distance, error);
    }
  }
  return result;
}

// Boxes are padded by 2·10⁻⁶ of the greatest coordinate: hits have to be nearer than that to where they are.
void expect_exact(const std::string& what, const Triangles& triangles, double refused) {
  constexpr std::size_t rays = 4000;
  SoupRandom random(12);
  const Judgement j = judge(triangles, random, rays);
  expect_exactly(what + ": wrong triangle", 0, static_cast<double>(j.wrong));
  expect_absolute(what + ": refused, share of the rays", 0, static_cast<double>(j.refused) / rays, refused);
  expect_absolute(what + ": distance of the hit, to the greatest coordinate", 0, j.distance, 2e-6);
}

TEST(Needles, AreHitWhereTheExactKernelSays) {
  for (const double width : {1e-2, 1e-4, 1e-6, 1e-7}) {
    SoupRandom random(7);
    expect_exact(fmt::format("needles 1 × {:g}", width), needles(random, 400, 1, width),
                 width < 1e-6 ? 5e-3 : 0);
  }
}

TEST(Giants, AreHitWhereTheExactKernelSays) {
  for (const double size : {1e3, 1e7}) {
    SoupRandom random(9);
    Triangles triangles = needles(random, 300, 0.3, 0.2);
    for (int i = 0; i < 20; ++i) {
      const Vector3d p = random.vector(1), q = normalize(random.vector(1)),
                     r = normalize(cross(q, random.vector(1)));
      const Point3d centre = Point3d{} + p * 0.5;
      triangles.push_back({rounded(centre - (q + r) * size), rounded(centre + q * (2 * size)),
                           rounded(centre + r * (2 * size))});
    }
    expect_exact(fmt::format("giants of {:g} among triangles of 0.3", size), triangles, 0);
  }
}

// A floor of two triangles `size` across under a point light 2 above it: E = I cosθ/d².
TEST(Giants, AreLitAsTheyShouldBe) {
  for (const float size : {1e2f, 1e5f, 1e7f, 1e9f}) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(0, size)}), matte(0.6f));
    add_point(scene, {0.5, 0.25, 2}, 7);
    set_camera(scene, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.002, 8, 8);
    const double d2 = 0.25 + 0.0625 + 4, expected = 0.6 / pi * 7 * (2 / std::sqrt(d2)) / d2;
    const Measured b = measure(scene, 64);
    expect_relative(fmt::format("a floor of {:g} lit from 2 above", size), expected, b.mean, 2e-5);
  }
}

// The same floor seen through a pane of 6 mm that stands on it, before a lamp of radiance 1: what the two
// faces let through, whatever the size of the floor.
TEST(Giants, LeaveSmallThingsAsTheyAre) {
  for (const float size : {1e2f, 1e4f, 1e6f, 1e7f, 1e9f}) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(0, size)}), matte(0));
    add_shape(scene, add_quads(scene, box_faces({-1, -0.003f, 0.001f}, {1, 0.003f, 1})),
              Material{DielectricMaterial{ConstantSpectrum{1.5f}}});
    add_shape(scene, add_quads(scene, {{{{-1, 1, 0.001f}, {1, 1, 0.001f}, {1, 1, 1}, {-1, 1, 1}}}}), matte(0),
              lamp(1, true));
    set_orthographic(scene, {0, -1, 0.5}, {0, 1, 0.5}, {0, 0, 1}, 0.1, 16);
    scene.settings.max_depth = 50;
    const double r = 0.04, expected = (1 - r) / (1 + r);
    const Measured b = measure(scene, 256);
    expect_relative(fmt::format("a pane of 6 mm on a floor of {:g}", size), expected, b.mean, 1e-4,
                    b.standard_error);
  }
}

// What reflects all and sees nothing but a sky of 1 shows it, unless rays hit what they leave or its
// neighbours.
void expect_white(const std::string& what, Scene& scene) {
  for (Material& material : scene.materials) material = matte(1);
  add_sky(scene, 1);
  scene.settings.max_depth = 1;
  expect_relative(what, 1, measure(scene, 64).mean, 1e-6);
}

// 16 × 16 tiles about the middle of a tilted floor of four giants, all of which floats place in one plane.
TEST(Giants, DoNotShadowWhatIsLevelWithThem) {
  for (const float size : {0x1p7f, 0x1p23f, 0x1p30f}) {
    const auto on_floor = [](double x, double y) { return rounded({x, y, 0.375 * x}); };
    std::vector<std::array<Point3f, 4>> quads;
    for (int i = -8; i < 8; ++i)
      for (int k = -8; k < 8; ++k) {
        const double x = i / 8.0, y = k / 8.0, d = 1 / 8.0;
        quads.push_back({on_floor(x, y), on_floor(x + d, y), on_floor(x + d, y + d), on_floor(x, y + d)});
      }
    const double s = static_cast<double>(size);
    quads.push_back({on_floor(-s, -s), on_floor(s, -s), on_floor(s, -1), on_floor(-s, -1)});
    quads.push_back({on_floor(-s, 1), on_floor(s, 1), on_floor(s, s), on_floor(-s, s)});
    quads.push_back({on_floor(-s, -1), on_floor(-1, -1), on_floor(-1, 1), on_floor(-s, 1)});
    quads.push_back({on_floor(1, -1), on_floor(s, -1), on_floor(s, 1), on_floor(1, 1)});
    Scene scene;
    add_shape(scene, add_quads(scene, quads), matte(1));
    set_camera(scene, {0.1, 0.2, 5}, {0, 0, 0}, {0, 1, 0}, 0.6, 32, 32);
    expect_white(fmt::format("tiles among giants of {:g}, white under a sky of 1", size), scene);
  }
}

// A ball of 2 · 24 · 48 triangles, with or without something that far away.
TEST(Giants, DoNotShadowWhatIsRound) {
  for (const double far : {1.0, 1e4, 1e7}) {
    TriangleMesh ball;
    constexpr int rings = 24, segments = 48;
    for (int i = 0; i <= rings; ++i)
      for (int k = 0; k < segments; ++k) {
        const double theta = pi * i / rings, phi = 2 * pi * k / segments;
        ball.positions.push_back(
            rounded({0.3 + 0.5 * std::sin(theta) * std::cos(phi), 0.2 + 0.5 * std::sin(theta) * std::sin(phi),
                     0.5 * std::cos(theta)}));
      }
    for (std::uint32_t i = 0; i < rings; ++i)
      for (std::uint32_t k = 0; k < segments; ++k) {
        const std::uint32_t a = i * segments + k, b = i * segments + (k + 1) % segments;
        ball.triangles.push_back({a, a + segments, b});
        ball.triangles.push_back({b, a + segments, b + segments});
      }
    Scene scene;
    scene.meshes.push_back(std::move(ball));
    add_shape(scene, {0}, matte(1));
    for (const double side : {-1.0, 1.0}) {
      const Point3f p = rounded({side * far, side * far, side * far});
      add_shape(scene, add_quads(scene, {{{p, p, p, p}}}), matte(1));
    }
    set_camera(scene, {0.3, -2, 0.4}, {0.3, 0.2, 0}, {0, 0, 1}, 0.6, 32, 32);
    expect_white(fmt::format("a ball with something {:g} away, white under a sky of 1", far), scene);
  }
}

}  // namespace
}  // namespace vitrail::test::triangles_test
