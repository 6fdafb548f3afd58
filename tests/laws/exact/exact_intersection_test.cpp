// SPDX-License-Identifier: Apache-2.0
// The first law, for the nearest hit: one answer to the last bit, whatever the kernel, the traversal and the
// cuts; and that answer is the true one.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <memory>

#include "partitioner/partition.h"
#include "tests/laws/exact/awkward_rays.h"
#include "tests/laws/exact/exact_oracle.h"
#include "tests/support/long_tests.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_scenes.h"
#include "tracer/intersect/embree_domain.h"
#include "tracer/rays/domain_tree.h"
#include "tracer/rays/walk.h"

namespace vitrail::test::exact_intersection_test {
namespace {

// A bundle with all its domains mapped.
struct Cut {
  Manifest manifest;
  std::vector<BvhNode> tree;  // of them
  std::vector<std::unique_ptr<MappedDomain>> domains;
  std::vector<const DomainView*> views;

  Cut(const Scene& scene, const std::filesystem::path& directory, const PartitionOptions& options) {
    partition(scene, directory, options);
    manifest = read_manifest(directory);
    tree = domain_tree(manifest);
    for (std::uint32_t i = 0; i < manifest.domains.size(); ++i) {
      domains.push_back(std::make_unique<MappedDomain>(domain_path(directory, i)));
      views.push_back(&domains.back()->view());
    }
  }

  Hit closest(const KernelFunctions& kernel, const Ray& ray) const {
    const RayConstants constants = prepare(ray);
    DomainWalk walk(manifest, ray);
    Hit hit;
    for (DomainWalk::Visit visit; walk.next(hit.t, visit);) {
      kernel.closest(domains[visit.domain]->view(), constants, hit);
    }
    return hit;
  }

  // The same by the tree of domains.
  Hit closest_by_tree(const KernelFunctions& kernel, const Ray& ray) const {
    Hit hit;
    std::uint32_t holder = 0;
    EXPECT_TRUE(kernel.domains_closest(tree.data(), views.data(), prepare(ray), hit, holder));
    return hit;
  }
  bool occluded_by_tree(const KernelFunctions& kernel, const Ray& ray, float tmax) const {
    return kernel.domains_occluded(tree.data(), views.data(), prepare(ray), tmax) == Passage::blocked;
  }

  bool occluded(const KernelFunctions& kernel, const Ray& ray, float tmax) const {
    const RayConstants constants = prepare(ray);
    DomainWalk walk(manifest, ray);
    for (DomainWalk::Visit visit; walk.next(double{tmax}, visit);) {
      if (kernel.occluded(domains[visit.domain]->view(), constants, tmax)) return true;
    }
    return false;
  }
};

// By global id, in the bundle's coordinates.
Triangles triangles_of(const Cut& uncut) {
  Triangles triangles(uncut.manifest.triangles);
  for (const Cluster& cluster : uncut.domains[0]->view().clusters) {
    for (std::size_t lane = 0; lane < cluster_width; ++lane) {
      if (cluster.id[lane] == no_triangle) continue;
      for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        const auto& v = cluster.vertex[vertex];
        triangles[cluster.id[lane]][vertex] = {v[0][lane], v[1][lane], v[2][lane]};
      }
    }
  }
  return triangles;
}

struct AwkwardScene {
  TemporaryDirectory directory;
  Scene scene;
  Cut uncut, eight, many;
  Triangles triangles;
  std::vector<Ray> rays;

  AwkwardScene(float size, Vector3f offset, std::size_t ray_count)
      : scene(scene_of(awkward_mesh(size, offset))),
        uncut(scene, directory.path() / "1", {.domains = 1}),
        eight(scene, directory.path() / "8", {.domains = 8, .median = true}),
        many(scene, directory.path() / "64", {.domains = 64}),
        triangles(triangles_of(uncut)),
        rays(awkward_rays(triangles, many.manifest.kd_nodes, ray_count)) {}

  const DomainView& whole() const { return uncut.domains[0]->view(); }
};

// How often something else than the reference came out, and how often of that one of the two was a miss.
struct Differences {
  std::atomic<std::uint64_t> differ{0}, leak{0}, occlusion{0};
  void count(const Hit& hit, const Hit& reference) {
    if (same(hit, reference)) return;
    ++differ;
    if (hit.triangle == no_triangle || reference.triangle == no_triangle) ++leak;
  }
  void count(bool occluded, bool reference) {
    if (occluded != reference) ++occlusion;
  }
};

void expect_none(const Differences& d, std::string_view what) {
  EXPECT_EQ(d.differ, 0u) << what;
  EXPECT_EQ(d.leak, 0u) << what;
  EXPECT_EQ(d.occlusion, 0u) << what;
}

// Ends of shadow rays on either side of the nearest hit: what has to be answered follows from its t.
float shadow_end(const Hit& nearest, std::size_t i) {
  const double factors[] = {1 - 1e-7, 1 + 1e-7, 0.5, 2};
  return static_cast<float>(nearest.t * factors[i % 4]);
}

void expect_one_answer(const AwkwardScene& scene) {
  const std::vector<Kernel> kernels = available_kernels();
  const KernelFunctions& best = best_kernel();
  const EmbreeDomain embree(scene.whole());
  std::vector<Differences> by_kernel(kernels.size());
  Differences by_embree, by_eight, by_many, by_tree;
  std::atomic<std::uint64_t> hits{0};
  tbb::parallel_for(std::size_t{0}, scene.rays.size(), [&](std::size_t i) {
    Ray ray = scene.rays[i];
    Hit nearest;
    best.closest(scene.whole(), prepare(ray), nearest);
    if (i % 5 == 0) {  // a continued ray
      ray.exclude = nearest.triangle;
      nearest = {};
      best.closest(scene.whole(), prepare(ray), nearest);
    }
    hits += nearest.triangle != no_triangle;
    const float tmax = shadow_end(nearest, i);
    const bool shadowed = nearest.t < double{tmax};
    const RayConstants constants = prepare(ray);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      Hit hit;
      kernel_functions(kernels[k]).closest(scene.whole(), constants, hit);
      by_kernel[k].count(hit, nearest);
      by_kernel[k].count(kernel_functions(kernels[k]).occluded(scene.whole(), constants, tmax), shadowed);
    }
    Hit hit;
    embree.closest(prepare(ray), hit);
    by_embree.count(hit, nearest);
    by_embree.count(embree.occluded(prepare(ray), tmax), shadowed);
    by_eight.count(scene.eight.closest(best, ray), nearest);
    by_eight.count(scene.eight.occluded(best, ray, tmax), shadowed);
    by_many.count(scene.many.closest(best, ray), nearest);
    by_many.count(scene.many.occluded(best, ray, tmax), shadowed);
    const KernelFunctions& any = kernel_functions(kernels[i % kernels.size()]);
    by_tree.count(scene.many.closest_by_tree(any, ray), nearest);
    by_tree.count(scene.many.occluded_by_tree(any, ray, tmax), shadowed);
  });
  EXPECT_GT(hits, scene.rays.size() / 3);
  for (std::size_t k = 0; k < kernels.size(); ++k) expect_none(by_kernel[k], name(kernels[k]));
  expect_none(by_embree, "through embree");
  expect_none(by_eight, "cut into 8");
  expect_none(by_many, "cut into 64");
  expect_none(by_tree, "cut into 64, by the tree of domains");
}

const AwkwardScene& plain_scene() {
  static const AwkwardScene scene(1, {}, of_all(1'000'000u, 200'000u));
  return scene;
}

TEST(ExactIntersection, InterfacesLieInGrids) {
  int planes = 0;
  for (const KdNode& node : plain_scene().eight.manifest.kd_nodes) {
    const int axis = static_cast<int>(node.axis);
    const auto in_plane =
        std::count_if(plain_scene().triangles.begin(), plain_scene().triangles.end(), [&](const Triangle& t) {
          return t[0][axis] == node.split && t[1][axis] == node.split && t[2][axis] == node.split;
        });
    planes += in_plane > 1000;
  }
  EXPECT_GE(planes, 3);
  EXPECT_GT(plain_scene().triangles.size(), 90'000u);
  EXPECT_EQ(plain_scene().many.domains.size(), 64u);
}

TEST(ExactIntersection, OneAnswer) { expect_one_answer(plain_scene()); }

TEST(ExactIntersection, OneAnswerAtEveryScaleAndPlace) {
  for (const float size : {1e-6f, 1e7f}) {
    expect_one_answer(AwkwardScene(size, {}, of_all(20'000u, 5'000u)));
    expect_one_answer(AwkwardScene(size, Vector3f{3, -5, 7} * size, of_all(20'000u, 5'000u)));
  }
}

// Filters and culling lose nothing.
TEST(ExactIntersection, SameAsTestingEveryTriangle) {
  const AwkwardScene& scene = plain_scene();
  std::atomic<int> differ{0};
  const std::size_t tries = of_all(1500, 500);
  tbb::parallel_for(std::size_t{0}, tries, [&](std::size_t i) {
    const Ray& ray = scene.rays[i * (scene.rays.size() / tries)];
    Hit hit;
    best_kernel().closest(scene.whole(), prepare(ray), hit);
    differ += !same(hit, brute_force(scene.whole(), ray));
  });
  EXPECT_EQ(differ, 0);
}

// What the tracer found against the exact crossings of one ray. A crossing is firm when it is neither within
// rounding of an edge nor nearly edge-on; the tracer must see those.
class Judge {
 public:
  explicit Judge(const AwkwardScene& scene) : scene_(scene), oracle_(scene.triangles) {}

  void judge(const Ray& ray) {
    const auto crossings = oracle_.crossings(ray);
    if (!crossings) return;
    ++judged;
    Hit hit;
    best_kernel().closest(scene_.whole(), prepare(ray), hit);
    ExactCrossing nearest{.t = std::numeric_limits<double>::infinity()};
    for (const ExactCrossing& c : *crossings) {
      const bool certain = c.t > 0 && c.inside > 1e-8 && c.sine > 1e-6;
      if (certain && (c.t < nearest.t || (c.t == nearest.t && c.triangle < nearest.triangle))) nearest = c;
    }
    firm += nearest.triangle != no_triangle;
    const double tolerance = 2e-6 / static_cast<double>(length(ray.direction));
    if (nearest.t < hit.t - tolerance) ++missed;
    if (hit.triangle == no_triangle) return;
    const auto c = oracle_.crossing(ray, hit.triangle);
    if (!c || c->inside < -1e-6 || std::abs(c->t - hit.t) > tolerance) ++invented;
    if (c && c->t == nearest.t && hit.triangle > nearest.triangle) ++wrong_of_equals;
  }

  std::size_t judged = 0, firm = 0, missed = 0, invented = 0, wrong_of_equals = 0;

 private:
  const AwkwardScene& scene_;
  ExactOracle oracle_;
};

TEST(ExactIntersection, AgreesWithExactArithmetic) {
  Judge judge(plain_scene());
  const std::vector<Ray>& rays = plain_scene().rays;
  const std::size_t tries = of_all(20'000, 5'000);
  for (std::size_t i = 0; i < tries; ++i) judge.judge(rays[i * (rays.size() / tries)]);
  EXPECT_GT(judge.judged, tries / 2);
  EXPECT_GT(judge.firm, tries / 4);
  EXPECT_EQ(judge.missed, 0u);
  EXPECT_EQ(judge.invented, 0u);
  EXPECT_EQ(judge.wrong_of_equals, 0u);
}

}  // namespace
}  // namespace vitrail::test::exact_intersection_test
