// SPDX-License-Identifier: Apache-2.0
// How fast a forest of instances is traced beside Embree's own instances, on one core: the same rays,
// interleaved, medians of the ratios. bench_instances [INSTANCES] [TRIANGLES OF ONE] [REPETITIONS]
#include <fmt/core.h>

#include <random>

#include "tests/bench/embree_triangles.h"
#include "tests/bench/timing.h"

namespace vitrail::test {
namespace {

// Leaves around the origin, as a tree has them: a cloud of small triangles.
Triangles tree(std::size_t count) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  const float size = 2 / std::sqrt(static_cast<float>(count));
  Triangles triangles;
  while (triangles.size() < count) {
    const auto vector = [&](float s) { return Vector3f{normal(random), normal(random), normal(random)} * s; };
    const Point3f p = Point3f{} + normalize(vector(1)) * (0.7f + 0.1f * normal(random));
    triangles.push_back({p, p + vector(size), p + vector(size)});
  }
  return triangles;
}

std::vector<Affine> places(std::size_t count) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-1, 1);
  const double reach = 0.8 * std::sqrt(static_cast<double>(count));
  std::vector<Affine> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double size = 1 + 0.4 * u(random);
    out.push_back(affine(translate({reach * u(random), reach * u(random), size}) *
                         rotate(3 * u(random), {0.2 * u(random), 0.2 * u(random), 1}) *
                         scale({size, size, size})));
  }
  return out;
}

struct Kept {
  ClusteredTriangles object;
  DomainView object_view;
  const DomainView* objects[1];
  std::vector<InstanceRef> refs;
  std::vector<BvhNode> nodes;
  DomainView domain;

  Kept(const Triangles& triangles, const std::vector<Affine>& where) : object(cluster(triangles)) {
    object_view = view_of(object);
    objects[0] = &object_view;
    Bounds3f bounds;
    for (const Triangle& t : triangles)
      for (const Point3f p : t) extend(bounds, p);
    std::vector<Bounds3f> boxes;
    for (const Affine& a : where) {
      boxes.push_back(placed_bounds(a, bounds));
    }
    for (std::size_t i = 0; i < where.size(); ++i) {
      refs.push_back({where[i], {}, {}, 0, static_cast<std::uint32_t>(i * triangles.size())});
      set_box(refs.back(), inflated(boxes[i], padding(greatest(boxes[i]))));
    }
    nodes = build_tree(boxes);
    domain.instances = refs;
    domain.instance_nodes = nodes;
    domain.objects = objects;
  }
};

class EmbreeInstances {
 public:
  EmbreeInstances(const Triangles& triangles, const std::vector<Affine>& where, RTCDevice device)
      : object_(rtcNewScene(device)), scene_(rtcNewScene(device)) {
    attach(object_, triangles, device);
    rtcCommitScene(object_);
    for (const Affine& a : where) {
      const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(instance, object_);
      float m[12];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) m[4 * i + j] = static_cast<float>(a.m[i][j]);
      rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, m);
      attach(scene_, instance);
    }
    rtcCommitScene(scene_);
  }
  ~EmbreeInstances() {
    rtcReleaseScene(scene_);
    rtcReleaseScene(object_);
  }
  EmbreeInstances(const EmbreeInstances&) = delete;
  EmbreeInstances& operator=(const EmbreeInstances&) = delete;

  float closest(const Ray& ray) const { return test::closest(scene_, ray).ray.tfar; }
  bool occluded(const Ray& ray) const { return test::occluded(scene_, ray, 1e30f); }

 private:
  RTCScene object_, scene_;
};

std::vector<Ray> primary_rays(std::size_t instances, int width) {
  const auto reach = static_cast<float>(std::sqrt(static_cast<double>(instances)));
  const Point3f eye{0.1f, -1.1f * reach, 0.35f * reach};
  std::vector<Ray> rays;
  for (int y = 0; y < width; ++y)
    for (int x = 0; x < width; ++x) {
      const auto at = [&](int i) {
        return 1.2f * (static_cast<float>(i) + 0.5f) / static_cast<float>(width) - 0.6f;
      };
      rays.push_back({eye, normalize(Vector3f{at(x), 1, at(y) - 0.35f})});
    }
  return rays;
}

std::vector<Ray> bounce_rays(const std::vector<Ray>& rays, const DomainView& domain) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::vector<Ray> out;
  for (const Ray& ray : rays) {
    Hit hit;
    best_kernel().closest(domain, prepare(ray), hit);
    if (hit.triangle == no_triangle) continue;
    const Vector3f d = normalize(Vector3f{normal(random), normal(random), normal(random)});
    // Clear of the triangle it starts on, which Embree would hit again.
    out.push_back({ray.origin + ray.direction * static_cast<float>(hit.t) + d * 1e-3f, d});
  }
  return out;
}

template <class Theirs, class Ours>
void compare(const char* what, const std::vector<Ray>& rays, int repetitions, Theirs theirs, Ours ours) {
  const std::size_t chunk = std::min<std::size_t>(rays.size(), 4000);
  std::vector<double> rates, ratios;
  std::uint64_t hits[2] = {};
  for (int i = 0; i < repetitions; ++i) {
    const std::size_t first = static_cast<std::size_t>(i) * chunk % (rays.size() - chunk + 1);
    double start = cpu_seconds();
    for (std::size_t k = first; k < first + chunk; ++k) hits[0] += theirs(rays[k]);
    const double embree_s = cpu_seconds() - start;
    start = cpu_seconds();
    for (std::size_t k = first; k < first + chunk; ++k) hits[1] += ours(rays[k]);
    const double ours_s = cpu_seconds() - start;
    rates.push_back(static_cast<double>(chunk) / ours_s * 1e-6);
    ratios.push_back(embree_s / ours_s);
  }
  fmt::print("{:10} {:6.3f} Mray/s, {:5.2f} of embree's instances; hits {} and {}\n", what, median(rates),
             median(ratios), hits[0], hits[1]);
}

}  // namespace
}  // namespace vitrail::test

int main(int argc, char** argv) {
  using namespace vitrail;
  using namespace vitrail::test;
  const auto argument = [&](int i, int otherwise) { return argc > i ? std::atoi(argv[i]) : otherwise; };
  const auto instances = static_cast<std::size_t>(argument(1, 2000));
  const Triangles triangles = tree(static_cast<std::size_t>(argument(2, 20000)));
  const int repetitions = argument(3, 100);
  const std::vector<Affine> where = places(instances);
  const Kept kept(triangles, where);
  const RTCDevice device = rtcNewDevice("threads=1");
  {
    const EmbreeInstances embree(triangles, where, device);
    fmt::print("{} instances of {} triangles\n", instances, triangles.size());
    const std::vector<Ray> primary = primary_rays(instances, 500), bounce = bounce_rays(primary, kept.domain);
    const auto closest = [&](const Ray& r) {
      Hit hit;
      best_kernel().closest(kept.domain, prepare(r), hit);
      return hit.triangle != no_triangle;
    };
    const auto embree_closest = [&](const Ray& r) { return std::isfinite(embree.closest(r)); };
    compare("primary", primary, repetitions, embree_closest, closest);
    compare("bounce", bounce, repetitions, embree_closest, closest);
    compare(
        "occluded", bounce, repetitions, [&](const Ray& r) { return embree.occluded(r); },
        [&](const Ray& r) { return best_kernel().occluded(kept.domain, prepare(r), 1e30f); });
  }
  rtcReleaseDevice(device);
}
