// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

#include "scene/system/diagnostics.h"
#include "tests/partitioner/hierarchy/clustered_mesh.h"
#include "tracer/intersect/embree_domain.h"

namespace vitrail::test::intersect_test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
const Triangle unit_triangle{Point3f{0, 0, 0}, Point3f{1, 0, 0}, Point3f{0, 1, 0}};

// Every kernel and Embree must agree; returns what they agree on.
Hit closest(const ClusteredTriangles& clustered, const Ray& ray, const Hit& before = {}) {
  const DomainView domain = view_of(clustered);
  Hit reference = before;
  EmbreeDomain(domain).closest(prepare(ray), reference);
  for (const Kernel kernel : available_kernels()) {
    Hit hit = before;
    kernel_functions(kernel).closest(domain, prepare(ray), hit);
    EXPECT_TRUE(same(hit, reference)) << name(kernel);
    EXPECT_EQ(hit.cluster, reference.cluster);
    EXPECT_EQ(hit.lane, reference.lane);
    const RayConstants constants = prepare(ray);
    Hit* const again = &(hit = before);
    kernel_functions(kernel).closest_of_many(domain, &constants, &again, 1);
    EXPECT_TRUE(same(hit, reference)) << name(kernel);
  }
  return reference;
}

bool occluded(const ClusteredTriangles& clustered, const Ray& ray, float tmax) {
  const DomainView domain = view_of(clustered);
  const bool reference = EmbreeDomain(domain).occluded(prepare(ray), tmax);
  for (const Kernel kernel : available_kernels()) {
    const RayConstants constants = prepare(ray);
    EXPECT_EQ(kernel_functions(kernel).occluded(domain, constants, tmax), reference) << name(kernel);
    bool blocked = !reference;
    kernel_functions(kernel).occluded_of_many(domain, &constants, &tmax, &blocked, 1);
    EXPECT_EQ(blocked, reference) << name(kernel);
  }
  return reference;
}

TEST(Intersect, OneTriangleFromBothSides) {
  const ClusteredTriangles c = cluster({unit_triangle});
  for (const float side : {1.0f, -1.0f}) {
    const Ray ray{{0.25f, 0.5f, 2 * side}, {0, 0, -side}};
    const Hit hit = closest(c, ray);
    EXPECT_EQ(hit.triangle, 0u);
    EXPECT_EQ(hit.t, side > 0 ? 2 : 2 + 0x1p-21);  // the back by its setback
    EXPECT_EQ(hit.u, 0.25);
    EXPECT_EQ(hit.v, 0.5);
    EXPECT_TRUE(occluded(c, ray, 2.5f));
    EXPECT_TRUE(occluded(c, ray, infinity));
    EXPECT_FALSE(occluded(c, ray, 2));
    EXPECT_FALSE(occluded(c, ray, 1.5f));
  }
}

// By what ray.h says of each number; of equal components the last is the greatest.
TEST(Intersect, PreparesRaysWhateverTheirDirection) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  const std::array<float, 9> special{0.0f, -0.0f, 1.0f, -1.0f, 2.0f, 1e-19f, -1e-19f, 1e-30f, 1e18f};
  for (int i = 0; i < 3000; ++i) {
    const auto component = [&] { return i % 3 == 0 ? normal(random) : special[random() % special.size()]; };
    const Ray ray{{normal(random), normal(random), normal(random)},
                  {component(), component(), component()},
                  static_cast<std::uint32_t>(i)};
    if (ray.direction.x == 0 && ray.direction.y == 0 && ray.direction.z == 0) continue;
    const RayConstants r = prepare(ray, 0.5);
    for (const std::uint32_t axis : {r.x, r.y})
      EXPECT_TRUE(std::abs(ray.direction[axis]) < std::abs(ray.direction[r.z]) ||
                  (std::abs(ray.direction[axis]) == std::abs(ray.direction[r.z]) && axis < r.z));
    EXPECT_EQ(r.x, (r.z + 1) % 3);
    EXPECT_EQ(r.y, (r.z + 2) % 3);
    const float dz = ray.direction[r.z];
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const float d = ray.direction[axis];
      EXPECT_EQ(r.origin[axis], ray.origin[axis]);
      EXPECT_EQ(r.near_row[axis], std::signbit(d) ? axis + 3 : axis);
      EXPECT_EQ(r.inverse_direction[axis],
                std::abs(d) * 1e18f > std::abs(dz) ? std::abs(dz) / d : std::copysign(1e18f, d));
    }
    EXPECT_EQ(r.exact_shear_x, double{ray.direction[r.x]} / double{dz});
    EXPECT_EQ(r.exact_shear_y, double{ray.direction[r.y]} / double{dz});
    EXPECT_EQ(r.sign_z, dz < 0 ? -1 : 1);
    EXPECT_EQ(r.exclude, ray.exclude);
    EXPECT_EQ(r.time_s, 0.5);
  }
}

TEST(Intersect, NothingBehindTheOrigin) {
  const ClusteredTriangles c = cluster({unit_triangle});
  EXPECT_EQ(closest(c, {{0.25f, 0.5f, 2}, {0, 0, 1}}).triangle, no_triangle);
  EXPECT_EQ(closest(c, {{0.25f, 0.25f, 0}, {0.1f, 0.2f, 1}}).triangle, no_triangle);
  EXPECT_FALSE(occluded(c, {{0.25f, 0.25f, 0}, {0.1f, 0.2f, 1}}, infinity));
}

TEST(Intersect, DepthsBelowNormalFloats) {
  const ClusteredTriangles c =
      cluster({unit_triangle, {Point3f{0, 0, -1}, Point3f{1, 0, -1}, Point3f{0, 1, -1}}});
  for (const float depth : {1.4e-45f, 1e-42f, 1e-38f})
    for (const float size : {1.0f, 1e-3f, 1e6f}) {
      const Ray ray{{0.3f, 0.3f, depth}, {0, 0, -size}};
      const Hit hit = closest(c, ray);
      EXPECT_EQ(hit.triangle, 0u);
      EXPECT_EQ(hit.t, double{depth} / double{size});
      EXPECT_TRUE(occluded(c, ray, 4 * depth / size + 1e-44f));
      EXPECT_FALSE(occluded(c, ray, depth / size / 4));
    }
}

TEST(Intersect, TrianglesBelowNormalFloats) {
  const float unit = 1e-42f;
  Triangles small;
  for (int i = 0; i < 500; ++i) {
    const float x = static_cast<float>(i % 25) * unit, y = static_cast<float>(i / 25) * unit;
    small.push_back({Point3f{x, y, 0}, Point3f{x + unit, y, 0}, Point3f{x, y + unit, 0}});
  }
  const ClusteredTriangles c = cluster(small);
  for (std::uint32_t i = 0; i < small.size(); ++i) {
    const Point3f p = small[i][0];
    const Ray ray{{p.x + unit / 4, p.y + unit / 4, unit}, {0, 0, -1}};
    EXPECT_EQ(closest(c, ray).triangle, i);
    EXPECT_TRUE(occluded(c, ray, 4 * unit));
  }
}

// A ray in the plane of a box's face is in the slab all along, from the furthest that the exact test accepts,
// too.
TEST(Intersect, ParallelRaysFromAfar) {
  Triangles strip;
  for (const float x : {0.0f, 1.0f, 2.0f, 3.0f})
    strip.push_back({Point3f{x, 0, 0}, Point3f{x + 1, 0, 0}, Point3f{x, 1, 0}});
  const ClusteredTriangles c = cluster(strip);
  for (const float distance : {3.0f, 1e8f, 1e12f, 1e14f})
    for (const float zero : {0.0f, -0.0f})
      for (std::uint32_t i = 0; i < strip.size(); ++i) {
        const Ray ray{{strip[i][0].x, 0.25f, distance}, {zero, 0, -distance}};
        EXPECT_EQ(closest(c, ray).triangle, i) << distance;
        EXPECT_TRUE(occluded(c, ray, 1.01f)) << distance;
      }
}

TEST(Intersect, EmptyDomain) {
  const ClusteredTriangles c = cluster({});
  EXPECT_EQ(closest(c, {{0, 0, 1}, {0, 0, -1}}).triangle, no_triangle);
  EXPECT_FALSE(occluded(c, {{0, 0, 1}, {0, 0, -1}}, infinity));
}

TEST(Intersect, ExcludedTriangleIsNotHit) {
  const ClusteredTriangles c = cluster({unit_triangle, unit_triangle});
  const Ray ray{{0.25f, 0.5f, 2}, {0, 0, -1}, 0};
  EXPECT_EQ(closest(c, ray).triangle, 1u);
  const ClusteredTriangles alone = cluster({unit_triangle});
  EXPECT_EQ(closest(alone, ray).triangle, no_triangle);
  EXPECT_FALSE(occluded(alone, ray, infinity));
}

TEST(Intersect, LeastIdOfEqualDistances) {
  const ClusteredTriangles c = cluster(Triangles(100, unit_triangle));
  const Ray ray{{0.25f, 0.5f, 2}, {0, 0, -1}};
  EXPECT_EQ(closest(c, ray).triangle, 0u);
  // A candidate from elsewhere stays unless (t, id) is less.
  EXPECT_EQ(closest(c, ray, {.t = 1.5, .triangle = 7}).triangle, 7u);
  EXPECT_EQ(closest(c, ray, {.t = 2, .triangle = 7}).triangle, 0u);
  const Hit held = closest(c, ray, {.t = 2, .triangle = 0, .cluster = 99, .lane = 5});
  EXPECT_EQ(held.cluster, 99u);
  EXPECT_EQ(held.lane, 5u);
}

TEST(Intersect, TrianglesWithoutAreaAreNotHit) {
  const Triangles without_area{{Point3f{0, 0, 0}, Point3f{0, 0, 0}, Point3f{0, 0, 0}},
                               {Point3f{0, 0, 0}, Point3f{1, 1, 0}, Point3f{1, 1, 0}},
                               {Point3f{0, 0, 0}, Point3f{0.1f, 0.7f, 0.3f}, Point3f{0.2f, 1.4f, 0.6f}},
                               {Point3f{-3, -3, -3}, Point3f{1, 1, 1}, Point3f{2, 2, 2}}};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (const Triangle& triangle : without_area) {
    const ClusteredTriangles c = cluster({triangle});
    for (int i = 0; i < 1000; ++i) {
      const Point3f origin{uniform(random) * 5, uniform(random) * 5, uniform(random) * 5};
      const Point3f target = triangle[1] + (triangle[2] - triangle[1]) * (i % 2 ? uniform(random) : 0);
      const Ray ray{origin, target - origin};
      for (const Kernel kernel : available_kernels()) {
        Hit hit;
        kernel_functions(kernel).closest(view_of(c), prepare(ray), hit);
        ASSERT_EQ(hit.triangle, no_triangle);
        ASSERT_FALSE(kernel_functions(kernel).occluded(view_of(c), prepare(ray), infinity));
      }
    }
  }
}

TEST(Intersect, LengthOfTheDirectionOnlyScalesT) {
  const ClusteredTriangles c = cluster({unit_triangle});
  const Vector3f direction{0.1f, -0.2f, -1};
  const Hit reference = closest(c, {{0.25f, 0.5f, 0.5f}, direction});
  ASSERT_EQ(reference.triangle, 0u);
  for (const int exponent : {-120, -60, 60, 120}) {
    const float scale = std::ldexp(1.0f, exponent);
    const Ray ray{{0.25f, 0.5f, 0.5f}, direction * scale};
    const Hit hit = closest(c, ray);
    EXPECT_EQ(std::ldexp(hit.t, exponent), reference.t);
    EXPECT_EQ(hit.u, reference.u);
    EXPECT_EQ(hit.v, reference.v);
    EXPECT_TRUE(occluded(c, ray, static_cast<float>(hit.t * 1.1)));
    EXPECT_FALSE(occluded(c, ray, static_cast<float>(hit.t * 0.9)));
  }
}

TEST(Intersect, DirectionsAlongAxes) {
  const ClusteredTriangles c = cluster({{Point3f{0, 0, 1}, Point3f{1, 0, 1}, Point3f{0, 1, 1}},
                                        {Point3f{1, 0, 0}, Point3f{1, 1, 0}, Point3f{1, 0, 1}},
                                        {Point3f{0, 1, 0}, Point3f{1, 1, 0}, Point3f{0, 1, 1}}});
  for (const float zero : {0.0f, -0.0f}) {
    EXPECT_EQ(closest(c, {{0.2f, 0.2f, 0.2f}, {zero, zero, 1}}).triangle, 0u);
    EXPECT_EQ(closest(c, {{0.2f, 0.2f, 0.2f}, {1, zero, zero}}).triangle, 1u);
    EXPECT_EQ(closest(c, {{0.2f, 0.2f, 0.2f}, {zero, 1, zero}}).triangle, 2u);
    EXPECT_EQ(closest(c, {{0.2f, 0.2f, 3.2f}, {zero, zero, -1}}).triangle, 0u);
  }
}

Triangles sphere(int rings, float radius) {
  const auto point = [&](int ring, int segment) {
    const double theta = M_PI * ring / rings, phi = 2 * M_PI * (segment % (2 * rings)) / (2 * rings);
    const double s = ring == 0 || ring == rings ? 0 : std::sin(theta);
    return Point3f{static_cast<float>(radius * s * std::cos(phi)),
                   static_cast<float>(radius * s * std::sin(phi)),
                   static_cast<float>(radius * std::cos(theta))};
  };
  Triangles triangles;
  for (int ring = 0; ring < rings; ++ring) {
    for (int segment = 0; segment < 2 * rings; ++segment) {
      const Point3f a = point(ring, segment), b = point(ring + 1, segment);
      const Point3f c = point(ring + 1, segment + 1), d = point(ring, segment + 1);
      if (ring + 1 < rings) triangles.push_back({a, b, c});
      if (ring > 0) triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

// Rays from within a closed surface hit it, through its vertices and edges too, at every scale.
TEST(Intersect, ClosedSurfaceIsWatertight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (const float radius : {1e-6f, 1.0f, 1e7f}) {
    const Triangles triangles = sphere(20, radius);
    const ClusteredTriangles c = cluster(triangles);
    for (const Triangle& triangle : triangles) {
      const Point3f origin =
          Point3f{} + Vector3f{uniform(random), uniform(random), uniform(random)} * (radius * 0.3f);
      const Vector3f edge = triangle[1] - triangle[0];
      for (const Point3f target : {triangle[0], triangle[0] + edge * 0.5f, triangle[0] + edge * 0.3f}) {
        for (const Kernel kernel : available_kernels()) {
          const Ray ray{origin, target - origin};
          Hit hit;
          kernel_functions(kernel).closest(view_of(c), prepare(ray), hit);
          ASSERT_NE(hit.triangle, no_triangle);
          ASSERT_TRUE(kernel_functions(kernel).occluded(view_of(c), prepare(ray), infinity));
        }
      }
    }
  }
}

// Traversal and filters lose nothing that the exact test accepts, from near and far.
TEST(Intersect, SameAsTestingEveryTriangle) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto vector = [&] { return Vector3f{uniform(random), uniform(random), uniform(random)}; };
  for (const float scale : {1e-6f, 1.0f, 1e7f}) {
    Triangles triangles;
    for (int i = 0; i < 600; ++i) {
      const Point3f center = Point3f{} + vector() * scale;
      const float size = scale * (i % 10 ? 0.1f : 1.0f);
      triangles.push_back({center + vector() * size, center + vector() * size, center + vector() * size});
    }
    const ClusteredTriangles c = cluster(triangles);
    const DomainView domain = view_of(c);
    const EmbreeDomain embree(domain);
    for (int i = 0; i < 900; ++i) {
      const float distance = i % 3 == 0 ? 1.0f : i % 3 == 1 ? 30.0f : 1e4f;
      const Point3f origin = Point3f{} + vector() * (scale * distance);
      const Ray ray{origin, triangles[random() % triangles.size()][0] + vector() * (scale * 0.2f) - origin};
      const Hit reference = brute_force(domain, ray);
      const float beyond = static_cast<float>(reference.t * (1 + 1e-6)),
                  before = static_cast<float>(reference.t * (1 - 1e-6));
      Hit by_embree;
      embree.closest(prepare(ray), by_embree);
      ASSERT_TRUE(same(by_embree, reference));
      ASSERT_EQ(embree.occluded(prepare(ray), beyond), reference.triangle != no_triangle);
      ASSERT_FALSE(embree.occluded(prepare(ray), before));
      for (const Kernel kernel : available_kernels()) {
        const KernelFunctions& functions = kernel_functions(kernel);
        Hit hit;
        functions.closest(domain, prepare(ray), hit);
        ASSERT_TRUE(same(hit, reference)) << name(kernel);
        ASSERT_EQ(functions.occluded(domain, prepare(ray), beyond), reference.triangle != no_triangle);
        ASSERT_FALSE(functions.occluded(domain, prepare(ray), before));
      }
    }
  }
}

TEST(Kernels, PortableIsAlwaysThere) {
  EXPECT_EQ(available_kernels().front(), Kernel::portable);
  EXPECT_EQ(name(Kernel::avx512), "avx512");
}

[[noreturn]] void report_kernel(const char* wanted) {
  setenv("VITRAIL_KERNEL", wanted, 1);
  try {
    std::exit(&best_kernel() == &kernel_functions(Kernel::portable) ? 0 : 1);
  } catch (const Error& error) {
    std::fputs(error.what(), stderr);
    std::exit(3);
  }
}

TEST(KernelsDeathTest, TheEnvironmentChooses) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(report_kernel("portable"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(report_kernel("mmx"), testing::ExitedWithCode(3),
              "VITRAIL_KERNEL=mmx is no kernel .* choose one of: portable");
}

Triangle random_triangle(std::mt19937& random) {
  std::uniform_real_distribution<float> in(-1, 1);
  Triangle t;
  for (Point3f& p : t) p = {in(random), in(random), in(random)};
  return t;
}

// To the middle of a triangle, from about 3 away.
Ray ray_to(const Triangle& t, std::mt19937& random) {
  std::normal_distribution<float> anywhere;
  const Point3f from{3 * anywhere(random), 3 * anywhere(random), 3 * anywhere(random)};
  const Vector3f to = (t[0] - Point3f{}) + (t[1] - Point3f{}) + (t[2] - Point3f{});
  return {from, Point3f{} + to * (1.0f / 3) - from};
}

TEST(Intersect, TheOrderOfTheVerticesDoesNotChangeTheDistance) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const Triangle t = random_triangle(random);
    const RayConstants ray = prepare(ray_to(t, random));
    constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    ExactHit first;
    for (int k = 0; k < 6; ++k) {
      const ClusteredTriangles c =
          cluster({{t[static_cast<std::size_t>(orders[k][0])], t[static_cast<std::size_t>(orders[k][1])],
                    t[static_cast<std::size_t>(orders[k][2])]}});
      const auto lane = static_cast<unsigned>(std::ranges::find(c.clusters[0].id, 0u) - c.clusters[0].id);
      ExactHit hit;
      ASSERT_TRUE(exact_hit(ray, c.clusters[0], lane, hit));
      if (k == 0) first = hit;
      EXPECT_EQ(hit.t, first.t);
      EXPECT_EQ(hit.front, first.front == (k < 3));
    }
  }
}

// A parallelogram as floats have it, cut along either diagonal, with a copy of it that faces the other way,
// itself cut along either.
TEST(Intersect, OfFacesInOnePlaneTheOneThatFacesTheRayIsSeen) {
  std::mt19937 random(2);
  int seen = 0, front = 0;
  for (int i = 0; i < 4000; ++i) {
    const Triangle t = random_triangle(random);
    const Point3f a = t[0], b = t[1], d = t[2], c = b + (d - a);
    const bool turned = i & 1, swapped = i & 2;
    Triangles faces{{a, b, c}, {a, c, d}};
    const Triangles back = turned ? Triangles{{d, c, b}, {d, b, a}} : Triangles{{c, b, a}, {d, c, a}};
    faces.insert(swapped ? faces.begin() : faces.end(), back.begin(), back.end());
    const Ray ray = ray_to(t, random);
    const Vector3f normal = cross(b - a, d - a);
    const float cosine = dot(normal, ray.direction) / (length(normal) * length(ray.direction));
    if (std::abs(cosine) < 0.15f) continue;
    const Hit hit = closest(cluster(faces), ray);
    ASSERT_NE(hit.triangle, no_triangle);
    const bool is_first = (hit.triangle < 2) != swapped;
    EXPECT_EQ(is_first, cosine < 0) << i;
    ++seen, front += is_first ? 1 : 0;
  }
  EXPECT_GT(seen, 3000);
  EXPECT_GT(front, 1000);
}

}  // namespace
}  // namespace vitrail::test::intersect_test
