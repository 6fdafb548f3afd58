// SPDX-License-Identifier: Apache-2.0
// The first law, for instances: a domain that keeps them gives the hits of the same domain flattened, to the
// last bit, whatever the kernel and the traversal.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <random>

#include "bundle/triangle_number.h"
#include "tests/laws/exact/awkward_rays.h"
#include "tests/support/long_tests.h"
#include "tracer/intersect/embree_domain.h"

namespace vitrail::test::instances_test {
namespace {

// What becomes an object, or the scene: triangles of its own, then instances.
struct Part {
  struct Use {
    std::uint32_t part;
    Affine to_parent;
  };
  Triangles triangles;
  std::vector<Use> uses;
};

// The last part is the scene. `parts` refer to earlier ones.
using Parts = std::vector<Part>;

std::size_t count(const Parts& parts, std::size_t part) {
  std::size_t sum = parts[part].triangles.size();
  for (const Part::Use& use : parts[part].uses) sum += count(parts, use.part);
  return sum;
}

void flatten(const Parts& parts, std::size_t part, const Affine* chain, Triangles& out) {
  for (Triangle t : parts[part].triangles) {
    if (chain) {
      for (Point3f& p : t) p = placed(*chain, p);
      if (mirrors(*chain)) std::swap(t[1], t[2]);
    }
    out.push_back(t);
  }
  for (const Part::Use& use : parts[part].uses) {
    const Affine next = chain ? compose(*chain, use.to_parent) : use.to_parent;
    flatten(parts, use.part, &next, out);
  }
}

// A part as a domain or an object keeps it.
struct Kept {
  DomainContent content;
  Bounds3f bounds;
  DomainView view;
};

Kept keep(const Parts& parts, std::size_t part, const std::vector<Kept>& before, bool padded) {
  Kept kept;
  for (const Triangle& t : parts[part].triangles)
    for (const Point3f& p : t) extend(kept.bounds, p);
  ClusteredTriangles built = cluster(parts[part].triangles, padded);
  kept.content.nodes = std::move(built.nodes);
  kept.content.clusters = std::move(built.clusters);
  std::size_t first = parts[part].triangles.size();
  std::vector<Bounds3f> boxes;
  for (const Part::Use& use : parts[part].uses) {
    Bounds3f box = placed_bounds(use.to_parent, before[use.part].bounds);
    extend(kept.bounds, box);
    box = inflated(box, padded ? padding(greatest(box)) : 0);
    InstanceRef ref{use.to_parent, {}, {}, use.part, static_cast<std::uint32_t>(first)};
    for (int axis = 0; axis < 3; ++axis) ref.lower[axis] = box.lower[axis], ref.upper[axis] = box.upper[axis];
    kept.content.instances.push_back(ref);
    boxes.push_back(box);
    first += count(parts, use.part);
  }
  kept.content.instance_nodes = build_tree(boxes);
  kept.view = view_of(kept.content);
  return kept;
}

// The ids of the scene's instances begin `gap` behind those of its own triangles.
struct Both {
  Both(const Parts& parts, std::uint32_t gap) {
    test::Triangles triangles;
    flatten(parts, parts.size() - 1, nullptr, triangles);
    all = std::move(triangles);
    flat = cluster(all);
    for (Cluster& c : flat.clusters)
      for (std::uint32_t& id : c.id)
        if (id != no_triangle && id >= parts.back().triangles.size()) id = number_from(gap, id);
    for (std::size_t i = 0; i < parts.size(); ++i)
      kept.push_back(keep(parts, i, kept, i + 1 == parts.size()));
    for (InstanceRef& ref : kept.back().content.instances)
      ref.first_triangle = number_from(gap, ref.first_triangle);
    for (Kept& k : kept) {
      k.view = view_of(k.content);
      views.push_back(&k.view);
    }
    domain = kept.back().view;
    domain.objects = views;
  }
  Triangles all;
  ClusteredTriangles flat;
  std::vector<Kept> kept;
  std::vector<const DomainView*> views;
  DomainView domain;
};

float shadow_end(const Hit& nearest, std::size_t i) {
  const double factors[] = {1 - 1e-7, 1 + 1e-7, 0.5, 2};
  return static_cast<float>(nearest.t * factors[i % 4]);
}

// The chain leads to the triangle that was hit.
bool leads_to_its_triangle(const Both& scene, const Hit& hit) {
  if (hit.triangle == no_triangle) return true;
  std::uint32_t first = 0;
  const DomainView* at = &scene.domain;
  for (std::uint32_t i = 0; i < hit.depth; ++i) {
    first = number_from(first, at->instances[hit.chain[i]].first_triangle);
    at = scene.domain.objects[at->instances[hit.chain[i]].object];
  }
  return number_from(first, at->clusters[hit.cluster].id[hit.lane]) == hit.triangle;
}

void expect_equal(const Parts& parts, std::size_t ray_count, bool reference = true, std::uint32_t gap = 0) {
  const Both scene(parts, gap);
  const DomainView flat = view_of(scene.flat);
  const KdNode planes[] = {{0, 0}, {0.1f * greatest_coordinate(scene.all), 1}, {0, 2}};
  const std::vector<Ray> rays = awkward_rays(scene.all, planes, test::of_all(ray_count, ray_count / 4));
  const std::vector<Kernel> kernels = available_kernels();
  const EmbreeDomain embree(scene.domain), rendered(scene.domain, EmbreeDomain::Instances::by_kernel);
  std::atomic<std::uint64_t> hits{0}, instance_hits{0}, differ{0}, occlusion{0}, lost_chains{0};
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
    Ray ray = rays[i];
    Hit nearest;
    best_kernel().closest(flat, prepare(ray), nearest);
    if (i % 5 == 0) {
      ray.exclude = nearest.triangle;
      nearest = {};
      best_kernel().closest(flat, prepare(ray), nearest);
    }
    hits += nearest.triangle != no_triangle;
    const float tmax = shadow_end(nearest, i);
    const bool shadowed = nearest.t < double{tmax};
    const auto check = [&](const Hit& hit, bool occluded) {
      differ += !same(hit, nearest);
      occlusion += occluded != shadowed;
      lost_chains += !leads_to_its_triangle(scene, hit);
      instance_hits += hit.depth > 0;
    };
    for (const Kernel kernel : kernels) {
      const KernelFunctions& f = kernel_functions(kernel);
      Hit hit;
      const RayConstants constants = prepare(ray);
      f.closest(scene.domain, constants, hit);
      check(hit, f.occluded(scene.domain, constants, tmax));
      Hit* const again = &(hit = {});
      bool blocked = !shadowed;
      f.closest_of_many(scene.domain, &constants, &again, 1);
      f.occluded_of_many(scene.domain, &constants, &tmax, &blocked, 1);
      check(hit, blocked);
    }
    if (!reference || i % 20 != 1) return;
    Hit hit;
    embree.closest(prepare(ray), hit);
    check(hit, embree.occluded(prepare(ray), tmax));
    hit = {};
    embree_kernel().closest(rendered, prepare(ray), hit);
    check(hit, embree_kernel().occluded(rendered, prepare(ray), tmax));
  });
  EXPECT_GT(hits, rays.size() / 10);
  EXPECT_GT(instance_hits, hits);
  EXPECT_EQ(differ, 0u);
  EXPECT_EQ(occlusion, 0u);
  EXPECT_EQ(lost_chains, 0u);
}

// A closed bumpy sphere of 4·rings² triangles, in floats.
Triangles sphere(int rings, float radius, float bump) {
  const auto point = [&](int ring, int segment) {
    const double theta = M_PI * ring / rings, phi = M_PI * (segment % (2 * rings)) / rings;
    const double s = ring == 0 || ring == rings ? 0 : std::sin(theta);
    const double r = double{radius} * (1 + double{bump} * s * std::sin(5 * theta) * std::sin(4 * phi));
    return cast<float>(Point3d{r * s * std::cos(phi), r * s * std::sin(phi), r * std::cos(theta)});
  };
  Triangles triangles;
  for (int ring = 0; ring < rings; ++ring)
    for (int segment = 0; segment < 2 * rings; ++segment) {
      const Point3f a = point(ring, segment), b = point(ring + 1, segment);
      const Point3f c = point(ring + 1, segment + 1), d = point(ring, segment + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  return triangles;
}

Affine random_transform(std::mt19937& random, double reach, double size, int kind) {
  std::uniform_real_distribution<double> u(-1, 1);
  const Vector3d axis{u(random), u(random), u(random)};
  Transform t = translate({reach * u(random), reach * u(random), reach * u(random)}) *
                rotate(3 * u(random), kind == 0 ? Vector3d{} : axis) * scale({size, size, size});
  if (kind == 2) t = t * scale({1, 0.1 + std::abs(u(random)), -1.5});                          // mirrored
  if (kind == 3) t = t * scale({1, 1e-3, 1}) * rotate(u(random), axis);                        // a sheet
  if (kind == 4) t = t * scale({1e-3, 1e-3, 1});                                               // a needle
  if (kind == 5) t = translate({0.3, 0.2, 0.1}) * rotate(u(random), axis) * scale({2, 2, 2});  // concentric
  return affine(t);
}

// Two objects, one of them with instances of the other, and a scene of both and a ground.
Parts forest(double size, std::uint32_t uses) {
  std::mt19937 random(7);
  const auto f = static_cast<float>(size);
  Parts parts(4);
  parts[0].triangles = sphere(8, 0.2f * f, 0.3f);
  parts[1].triangles = sphere(5, 0.1f * f, 0.1f);
  for (int i = 0; i < 6; ++i) parts[1].uses.push_back({0, random_transform(random, 0.3 * size, 0.5, i)});
  parts[2].uses = {{1, random_transform(random, 0.1 * size, 1, 1)}, {0, random_transform(random, 0, 1, 2)}};
  parts[3].triangles = {{Point3f{-f, -f, -f}, Point3f{f, -f, -f}, Point3f{0, f, -f}}};
  for (std::uint32_t i = 0; i < uses; ++i)
    parts[3].uses.push_back({i % 3, random_transform(random, size, 0.5, static_cast<int>(i % 6))});
  return parts;
}

TEST(Instances, SameHitsAsFlattened) { expect_equal(forest(1, 40), 100'000); }

TEST(Instances, AtEverySize) {
  expect_equal(forest(1e-6, 20), 5'000, false);
  expect_equal(forest(1e7, 20), 20'000, false);
}

// An instance far from the others and from its own centre; one that is far larger than its object.
TEST(Instances, FarAwayAndOfUnlikeSizes) {
  Parts parts = forest(1, 12);
  for (Triangle& t : parts[0].triangles)
    for (Point3f& p : t) p = p + Vector3f{1000, 0, 0};
  parts[3].uses.push_back({0, affine(translate({-1000, 0, 0}))});
  parts[3].uses.push_back({1, affine(translate({0, 5000, 0}) * scale({1e4, 1e4, 1e4}))});
  parts[3].uses.push_back({1, affine(translate({0.5, 0.5, 0}) * scale({1e-3, 1e-3, 1e-3}))});
  expect_equal(parts, 20'000, false);
}

// Coinciding instances: of equal t the least id wins, wherever it is found.
// A ray in such an object has margins that no float holds: it still enters no child that is not there.
TEST(Instances, FlatterThanFloatsTell) {
  for (const double thickness : {1e-12, 1e-25, 1e-37}) {
    Parts parts = forest(1, 12);
    for (Part::Use& use : parts[3].uses)
      for (double& x : use.to_parent.m[2]) x *= thickness;
    expect_equal(parts, 2'000, false);
  }
}

TEST(Instances, CoincidingOnesAreDecidedById) {
  Parts parts = forest(1, 6);
  const std::vector<Part::Use> uses = parts[3].uses;
  parts[3].uses.insert(parts[3].uses.end(), uses.rbegin(), uses.rend());
  expect_equal(parts, 20'000, false);
}

// As in scenes of more triangles than numbers: after half of these they are 0, 1, 2 …
TEST(Instances, WhereNumbersBeginAnew) {
  Parts parts = forest(1, 12);
  const std::vector<Part::Use> uses = parts[3].uses;
  parts[3].uses.insert(parts[3].uses.end(), uses.rbegin(), uses.rend());
  const auto half = static_cast<std::uint32_t>(count(parts, 3) / 2);
  for (const std::uint32_t step : {half, half + 17, half / 3})
    expect_equal(parts, 20'000, true, triangle_numbers - step);
}

}  // namespace
}  // namespace vitrail::test::instances_test
