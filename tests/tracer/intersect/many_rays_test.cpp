// SPDX-License-Identifier: Apache-2.0
// Many rays at a time meet what each meets alone, to the last bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "tests/partitioner/hierarchy/clustered_mesh.h"

namespace vitrail::test::many_rays_test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Counts {
  std::size_t hits = 0, blocked = 0;
};

// All kernels, in batches of any size, against one ray after the other; `before` is what is known of each.
void expect_same(const ClusteredTriangles& clustered, const std::vector<Ray>& rays,
                 const std::vector<Hit>& before, const std::vector<float>& ends, Counts& counts) {
  const DomainView domain = view_of(clustered);
  std::vector<RayConstants> constants;
  std::vector<Hit> alone = before;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    constants.push_back(prepare(rays[i]));
    kernel_functions(Kernel::portable).closest(domain, constants[i], alone[i]);
    counts.hits += alone[i].triangle != before[i].triangle;
  }
  for (const Kernel kernel : available_kernels()) {
    const KernelFunctions& functions = kernel_functions(kernel);
    for (const std::size_t batch : {std::size_t{1}, std::size_t{9}, rays.size()}) {
      std::vector<Hit> hits = before;
      std::vector<Hit*> places;
      for (Hit& hit : hits) places.push_back(&hit);
      const auto blocked = std::make_unique<bool[]>(rays.size());
      for (std::size_t i = 0; i < rays.size(); i += batch) {
        const std::size_t count = std::min(batch, rays.size() - i);
        functions.closest_of_many(domain, &constants[i], &places[i], count);
        functions.occluded_of_many(domain, &constants[i], &ends[i], &blocked[i], count);
      }
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(same(hits[i], alone[i])) << name(kernel) << " " << i << " of " << batch;
        ASSERT_EQ(hits[i].cluster, alone[i].cluster);
        ASSERT_EQ(hits[i].lane, alone[i].lane);
        const bool is_blocked = functions.occluded(domain, constants[i], ends[i]);
        counts.blocked += is_blocked;
        ASSERT_EQ(blocked[i], is_blocked) << name(kernel) << " " << i << " of " << batch;
      }
    }
  }
}

// Where a shadow ray may end: anywhere, and where the float that is nearest to a hit lies.
float end_of(const DomainView& domain, const Ray& ray, std::size_t i) {
  const auto t = static_cast<float>(brute_force(domain, ray).t);
  const float ends[] = {infinity, t, std::nextafter(t, 0.0f), std::nextafter(t, infinity), t / 2, 0};
  return ends[i % std::size(ends)];
}

TEST(ManyRays, MeetWhatEachMeetsAlone) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto vector = [&] { return Vector3f{uniform(random), uniform(random), uniform(random)}; };
  Counts counts;
  for (const float scale : {1e-6f, 1.0f, 1e7f})
    for (const int triangle_count : {1, 8, 36, 60, 600}) {
      Triangles triangles;
      for (int i = 0; i < triangle_count; ++i) {
        const Point3f center = Point3f{} + vector() * scale;
        const float size = scale * (i % 4 ? 0.3f : 2.0f);
        triangles.push_back({center + vector() * size, center + vector() * size, center + vector() * size});
      }
      const ClusteredTriangles c = cluster(triangles);
      ASSERT_TRUE(triangle_count > 36 || c.nodes.size() == 1);
      std::vector<Ray> rays;
      std::vector<float> ends;
      std::vector<Hit> before;
      for (std::size_t i = 0; i < 300; ++i) {
        const float distance = i % 3 == 0 ? 1.0f : i % 3 == 1 ? 30.0f : 1e4f;
        const Point3f origin = Point3f{} + vector() * (scale * distance);
        const Point3f target = triangles[random() % triangles.size()][0] + vector() * (scale * 0.2f);
        rays.push_back({origin, target - origin});
        if (i % 4 == 0) rays[i].exclude = brute_force(view_of(c), rays[i]).triangle;
        ends.push_back(end_of(view_of(c), rays[i], i));
        before.push_back({});
        if (i % 5 == 0) before[i].t = std::abs(static_cast<double>(uniform(random))), before[i].triangle = 5;
      }
      expect_same(c, rays, before, ends, counts);
    }
  EXPECT_GT(counts.hits, 1000u);
  EXPECT_GT(counts.blocked, 1000u);
}

// Small whole numbers: edges and vertices are met, planes run along rays, and several triangles lie in one
// place.
TEST(ManyRays, MeetEdgesAndVerticesAsEachDoes) {
  std::mt19937 random(19);
  const auto number = [&] {
    const auto n = static_cast<float>(static_cast<int>(random() % 5) - 2);
    return n == 0 && random() % 2 ? -0.0f : n;
  };
  const auto point = [&] { return Point3f{number(), number(), number()}; };
  Counts counts;
  int of_one_node = 0;
  for (int round = 0; round < 60; ++round) {
    Triangles triangles;
    for (int i = 0; i < 30; ++i) triangles.push_back({point(), point(), point()});
    triangles.push_back(triangles[3]);
    triangles.push_back({triangles[7][1], triangles[7][0], triangles[7][2]});
    const ClusteredTriangles c = cluster(triangles);
    of_one_node += c.nodes.size() == 1;
    std::vector<Ray> rays;
    std::vector<float> ends;
    std::vector<Hit> before(200);
    while (rays.size() < before.size()) {
      Ray ray{point(), {number(), number(), number()}};
      if (ray.direction.x == 0 && ray.direction.y == 0 && ray.direction.z == 0) continue;
      const std::size_t i = rays.size();
      if (i % 3 == 0) ray.origin = ray.origin - ray.direction * 8.0f;
      if (i % 4 == 0) ray.exclude = brute_force(view_of(c), ray).triangle;
      rays.push_back(ray);
      ends.push_back(end_of(view_of(c), ray, i / 2));
      if (i % 5 == 0) before[i].t = 2, before[i].triangle = i % 2 ? 3 : 99;
    }
    expect_same(c, rays, before, ends, counts);
  }
  EXPECT_GT(of_one_node, 20);
  EXPECT_GT(counts.hits, 1000u);
  EXPECT_GT(counts.blocked, 1000u);
}

}  // namespace
}  // namespace vitrail::test::many_rays_test
