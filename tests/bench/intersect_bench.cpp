// SPDX-License-Identifier: Apache-2.0
// How fast exact intersection is beside Embree's own triangles, on one core: the same rays, interleaved,
// medians of the ratios. bench_intersect [MILLIONS OF TRIANGLES] [REPETITIONS]
#include <fmt/core.h>

#include <functional>
#include <random>

#include "tests/bench/embree_triangles.h"
#include "tests/bench/timing.h"
#include "tracer/intersect/embree_domain.h"

namespace vitrail::test {
namespace {

using Rays = std::vector<Ray>;

// A closed sphere whose radius wavers, 4·rings² triangles.
void add_bumpy_sphere(Triangles& triangles, int rings, double radius, double bump) {
  const auto point = [&](int ring, int segment) {
    const double theta = M_PI * ring / rings, phi = M_PI * (segment % (2 * rings)) / rings;
    const double s = ring == 0 || ring == rings ? 0 : std::sin(theta);
    const double waver = std::sin(17 * theta) * std::sin(13 * phi) + 0.5 * std::sin(61 * theta + 43 * phi);
    const double r = radius * (1 + bump * s * waver);
    return cast<float>(Point3d{r * s * std::cos(phi), r * s * std::sin(phi), r * std::cos(theta)});
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int segment = 0; segment < 2 * rings; ++segment) {
      const Point3f a = point(ring, segment), b = point(ring + 1, segment);
      const Point3f c = point(ring + 1, segment + 1), d = point(ring, segment + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
}

class EmbreeTriangles {
 public:
  EmbreeTriangles(const Triangles& triangles, RTCDevice device, RTCSceneFlags flags)
      : scene_(rtcNewScene(device)) {
    rtcSetSceneFlags(scene_, flags);
    attach(scene_, triangles, device);
    const double start = cpu_seconds();
    rtcCommitScene(scene_);
    build_s_ = cpu_seconds() - start;
  }
  ~EmbreeTriangles() { rtcReleaseScene(scene_); }
  EmbreeTriangles(const EmbreeTriangles&) = delete;
  EmbreeTriangles& operator=(const EmbreeTriangles&) = delete;
  double build_s() const { return build_s_; }

  std::uint32_t closest(const Ray& ray) const {
    const RTCHit hit = test::closest(scene_, ray).hit;
    return hit.geomID == RTC_INVALID_GEOMETRY_ID ? no_triangle : hit.primID;
  }
  bool occluded(const Ray& ray, float tmax) const { return test::occluded(scene_, ray, tmax); }

 private:
  RTCScene scene_;
  double build_s_ = 0;
};

Rays primary_rays(int width) {
  Rays rays;
  const Point3f eye{0.1f, -2.2f, 0.2f};
  for (int y = 0; y < width; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto at = [&](int i) {
        return 1.6f * (static_cast<float>(i) + 0.5f) / static_cast<float>(width) - 0.8f;
      };
      rays.push_back({eye, normalize(Vector3f{at(x), 1, at(y)})});
    }
  }
  return rays;
}

struct Continued {
  Rays bounce;  // from the hits, in random directions over the surface
  Rays shadow;  // from the hits to a light; t = 1 at the light
};

Continued continue_rays(const Rays& rays, const Triangles& triangles, const DomainView& domain) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  Continued next;
  for (const Ray& ray : rays) {
    Hit hit;
    best_kernel().closest(domain, prepare(ray), hit);
    if (hit.triangle == no_triangle) continue;
    const Triangle& triangle = triangles[hit.triangle];
    Vector3f n = normalize(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
    if (dot(n, ray.direction) > 0) n = -n;
    const Point3f origin = ray.origin + ray.direction * static_cast<float>(hit.t) + n * 1e-4f;
    Vector3f d = normalize(Vector3f{normal(random), normal(random), normal(random)});
    if (dot(d, n) < 0) d = -d;
    next.bounce.push_back({origin, d});
    next.shadow.push_back({origin, Point3f{1.9f, -1.4f, 1.7f} - origin});
  }
  return next;
}

// A way to ask for one ray; what it returns is summed, so that nothing is optimised away and answers can be
// compared.
struct Variant {
  const char* name;
  std::function<std::uint64_t(const Ray*, const Ray*)> trace;
};

void compare(const char* rays_name, const Rays& rays, const std::vector<Variant>& variants, int repetitions) {
  const std::size_t chunk = std::min<std::size_t>(rays.size(), 4'000);
  std::vector<std::vector<double>> rates(variants.size()), ratios(variants.size());
  std::vector<std::uint64_t> sums(variants.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const std::size_t first = static_cast<std::size_t>(repetition) * chunk % (rays.size() - chunk + 1);
    std::vector<double> seconds(variants.size());
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const double start = cpu_seconds();
      sums[i] += variants[i].trace(&rays[first], &rays[first] + chunk);
      seconds[i] = cpu_seconds() - start;
    }
    for (std::size_t i = 0; i < variants.size(); ++i) {
      rates[i].push_back(static_cast<double>(chunk) / seconds[i] * 1e-6);
      ratios[i].push_back(seconds[0] / seconds[i]);
    }
  }
  for (std::size_t i = 0; i < variants.size(); ++i) {
    fmt::print("{:18} {:22} {:6.2f} Mray/s   {:5.2f} of embree's triangles   answers {:016x}\n", rays_name,
               variants[i].name, median(rates[i]), median(ratios[i]), sums[i]);
  }
}

template <class Ask>
Variant variant(const char* name, Ask ask) {
  return {name, [ask](const Ray* ray, const Ray* end) {
            std::uint64_t sum = 0;
            for (; ray != end; ++ray) sum += ask(*ray);
            return sum;
          }};
}

std::uint64_t answer(const Hit& hit) {
  return (__builtin_bit_cast(std::uint64_t, hit.t) ^ __builtin_bit_cast(std::uint64_t, hit.u) * 3 ^
          __builtin_bit_cast(std::uint64_t, hit.v) * 5) +
         hit.triangle;
}

void compare_traversals(const Triangles& triangles, const DomainView& domain, RTCDevice device,
                        int repetitions) {
  const EmbreeTriangles fast(triangles, device, RTC_SCENE_FLAG_NONE),
      robust(triangles, device, RTC_SCENE_FLAG_ROBUST);
  const EmbreeDomain through_embree(domain);
  std::vector<Variant> closest{variant("embree triangles", [&](const Ray& r) { return fast.closest(r); }),
                               variant("embree robust", [&](const Ray& r) { return robust.closest(r); }),
                               variant("ours through embree", [&](const Ray& r) {
                                 Hit hit;
                                 through_embree.closest(prepare(r), hit);
                                 return answer(hit);
                               })};
  std::vector<Variant> shadow{
      variant("embree triangles", [&](const Ray& r) { return fast.occluded(r, 1); }),
      variant("embree robust", [&](const Ray& r) { return robust.occluded(r, 1); }),
      variant("ours through embree", [&](const Ray& r) { return through_embree.occluded(prepare(r), 1); })};
  for (const Kernel kernel : available_kernels()) {
    const KernelFunctions& functions = kernel_functions(kernel);
    closest.push_back(variant(name(kernel).data(), [&](const Ray& r) {
      Hit hit;
      functions.closest(domain, prepare(r), hit);
      return answer(hit);
    }));
    shadow.push_back(variant(name(kernel).data(),
                             [&](const Ray& r) { return functions.occluded(domain, prepare(r), 1); }));
  }
  const Rays primary = primary_rays(700);
  const Continued first = continue_rays(primary, triangles, domain);
  const Continued second = continue_rays(first.bounce, triangles, domain);
  compare("primary", primary, closest, repetitions);
  compare("bounce", first.bounce, closest, repetitions);
  compare("occluded primary", first.shadow, shadow, repetitions);
  compare("occluded bounce", second.shadow, shadow, repetitions);
}

void compare_loading(const Triangles& triangles, const std::filesystem::path& file, RTCDevice device) {
  std::vector<double> load, build;
  for (int i = 0; i < 7; ++i) {
    const double start = cpu_seconds();
    const MappedDomain mapped(file);
    load.push_back(cpu_seconds() - start);
    build.push_back(EmbreeTriangles(triangles, device, RTC_SCENE_FLAG_NONE).build_s());
  }
  fmt::print("load {:.4f} s (mapped and verified), embree's build {:.3f} s: {:.1f} times as fast\n",
             median(load), median(build), median(build) / median(load));
}

}  // namespace
}  // namespace vitrail::test

int main(int argc, char** argv) {
  using namespace vitrail;
  using namespace vitrail::test;
  const double millions = argc > 1 ? std::atof(argv[1]) : 1;
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 150;
  Triangles triangles;
  const int rings = static_cast<int>(std::sqrt(millions * 1e6 / 8));
  add_bumpy_sphere(triangles, rings, 1, 0.06);
  add_bumpy_sphere(triangles, rings, 3, 0.04);
  const double start = cpu_seconds();
  const ClusteredTriangles clustered = cluster(triangles);
  fmt::print("{} triangles, {} clusters, {} nodes, {:.1f} bytes a triangle, clustered in {:.2f} s\n",
             triangles.size(), clustered.clusters.size(), clustered.nodes.size(),
             static_cast<double>(clustered.clusters.size() * sizeof(Cluster) +
                                 clustered.nodes.size() * sizeof(BvhNode)) /
                 static_cast<double>(triangles.size()),
             cpu_seconds() - start);
  const RTCDevice device = rtcNewDevice("threads=1");
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "vitrail_bench_intersect.dom";
  write_domain_file(file, {clustered.nodes, clustered.clusters, {}, {}, {}});
  compare_traversals(triangles, MappedDomain(file).view(), device, repetitions);
  compare_loading(triangles, file, device);
  std::filesystem::remove(file);
  rtcReleaseDevice(device);
}
