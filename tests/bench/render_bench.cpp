// SPDX-License-Identifier: Apache-2.0
// What a whole render costs beside the intersections it cannot do without, what sub-domains cost, what a
// second rank gains; all as ratios within one run. Seconds on a shared machine mean little by themselves.
//
//   bench_render [--spp N]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "partitioner/partition.h"
#include "tests/bench/timing.h"
#include "tests/support/command.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"
#include "tracer/transport/waves/tracer.h"

namespace vitrail::test {
namespace {

// A sphere whose radius ripples, seen as rough by bounced rays.
void add_bumpy_sphere(Scene& scene, Point3f centre, float radius, std::uint32_t rings) {
  TriangleMesh mesh;
  const std::uint32_t sectors = 2 * rings;
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t j = 0; j < sectors; ++j) {
      const double theta = 3.14159265358979 * i / rings, phi = 6.28318530717959 * j / sectors;
      const double r = radius * (1 + 0.04 * std::sin(23 * theta) * std::sin(31 * phi));
      mesh.positions.push_back({centre.x + static_cast<float>(r * std::sin(theta) * std::cos(phi)),
                                centre.y + static_cast<float>(r * std::sin(theta) * std::sin(phi)),
                                centre.z + static_cast<float>(r * std::cos(theta))});
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < sectors; ++j) {
      const std::uint32_t a = i * sectors + j, b = i * sectors + (j + 1) % sectors;
      if (i > 0) mesh.triangles.push_back({a, a + sectors, b});
      if (i + 1 < rings) mesh.triangles.push_back({b, a + sectors, b + sectors});
    }
  scene.meshes.push_back(std::move(mesh));
  add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)},
            Material{DiffuseMaterial{ConstantSpectrum{0.7f}}});
}

// Eight bumpy spheres in a room with a lamp: 1.06 million triangles.
Scene bench_scene() {
  Scene scene;
  for (int i = 0; i < 8; ++i)
    add_bumpy_sphere(scene, {i & 1 ? 1.2f : -1.2f, i & 2 ? 1.2f : -1.2f, i & 4 ? 1.2f : -1.2f}, 1.05f, 182);
  auto walls = box_faces({-3, -3, -3}, {3, 3, 3});
  for (auto& face : walls) std::swap(face[1], face[3]);
  add_shape(scene, add_quads(scene, walls), Material{DiffuseMaterial{ConstantSpectrum{0.6f}}});
  add_shape(scene, add_quads(scene, {{{{-1, 2.95f, -1}, {1, 2.95f, -1}, {1, 2.95f, 1}, {-1, 2.95f, 1}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{10}, true});
  set_camera(scene, {0, 0, -2.9}, {0, 0, 0}, {0, 1, 0}, 1.4, 256, 256);
  return scene;
}

// Records every call of the intersector, so that the same rays can be traced again without anything else.
struct Recorded {
  RayConstants ray;
  float tmax;  // of shadow rays; < 0: a closest hit is asked for
};
std::vector<Recorded> recording;
const KernelFunctions* recorded_kernel = nullptr;

KernelFunctions recorder() {
  recorded_kernel = &best_kernel();
  KernelFunctions k = *recorded_kernel;
  k.tree_closest = [](const BvhNode* nodes, const Cluster* clusters, const RayConstants& ray, Hit& hit) {
    recording.push_back({ray, -1});
    recorded_kernel->tree_closest(nodes, clusters, ray, hit);
  };
  k.tree_occluded = [](const BvhNode* nodes, const Cluster* clusters, const RayConstants& ray, float tmax) {
    recording.push_back({ray, tmax});
    return recorded_kernel->tree_occluded(nodes, clusters, ray, tmax);
  };
  return k;
}

double trace_all(const RenderScene& scene, const DomainView* view, const KernelFunctions& kernel, int spp) {
  Film film(scene.manifest.film, {});
  Outbox outbox;
  TraceCounters counters;
  Wave wave;
  Tracer tracer({scene, ResidentViews(&view, 1), film, outbox, counters, nullptr, nullptr, kernel}, wave);
  const double start = cpu_seconds();
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (int s = 0; s < spp; ++s) tracer.trace_camera(x, y, static_cast<std::uint32_t>(s));
  tracer.finish();
  return cpu_seconds() - start;
}

double replay(const DomainView& view) {
  const KernelFunctions& kernel = best_kernel();
  std::uint64_t hits = 0;
  const double start = cpu_seconds();
  for (const Recorded& r : recording) {
    if (r.tmax >= 0) {
      hits += kernel.occluded(view, r.ray, r.tmax);
    } else {
      Hit hit;
      kernel.closest(view, r.ray, hit);
      hits += hit.triangle != no_triangle;
    }
  }
  const double seconds = cpu_seconds() - start;
  if (hits == 0) fmt::print("no ray hit anything\n");
  return seconds;
}

void against_the_bare_intersector(const std::filesystem::path& bundle, int spp) {
  const RenderScene scene(read_manifest(bundle), bundle, 1 << 30, 0);
  const MappedDomain domain(domain_path(bundle, 0));
  const KernelFunctions recording_kernel = recorder();
  trace_all(scene, &domain.view(), recording_kernel, spp);
  std::vector<double> whole, bare;
  for (int i = 0; i < 3; ++i) {
    whole.push_back(trace_all(scene, &domain.view(), best_kernel(), spp));
    bare.push_back(replay(domain.view()));
  }
  const double rays = static_cast<double>(recording.size());
  fmt::print("render, 1 domain            {:6.3f} Mray/CPU-s\n", rays / median(whole) * 1e-6);
  fmt::print("bare intersector, same rays {:6.3f} Mray/CPU-s\n", rays / median(bare) * 1e-6);
  fmt::print("ratio                       {:6.3f}   (target >= 0.5)\n\n", median(bare) / median(whole));
  recording.clear();
}

nlohmann::json run_once(const TemporaryDirectory& directory, int domains, int ranks, int spp) {
  const auto stats = directory / "stats.json";
  const CommandResult done = run(fmt::format("{} '{}' -o '{}' --force --threads 1 --spp {} --stats '{}'",
                                             ranks > 1 ? mpi_vitrail("render", ranks) : vitrail("render"),
                                             (directory / fmt::format("{}.vit", domains)).string(),
                                             (directory / "picture.film").string(), spp, stats.string()));
  if (done.status != 0) throw std::runtime_error(done.output);
  return read_json(stats);
}

void domains_and_ranks(const TemporaryDirectory& directory, int spp) {
  std::vector<double> one, many, solo, pair;
  for (int i = 0; i < 3; ++i) {
    const auto a = run_once(directory, 1, 1, spp), b = run_once(directory, 64, 1, spp),
               c = run_once(directory, 1, 2, spp);
    if (a["film_hash"] != b["film_hash"] || a["film_hash"] != c["film_hash"]) fmt::print("FILMS DIFFER\n");
    one.push_back(a["cpu_s"]);
    many.push_back(b["cpu_s"]);
    solo.push_back(a["wall_s"]);
    pair.push_back(c["wall_s"]);
  }
  fmt::print("64 domains / 1 domain, CPU       {:5.3f}   (target <= 1.3)\n", median(many) / median(one));
  fmt::print("1 rank / 2 ranks, wall           {:5.3f}   (target >= 1.7)\n", median(solo) / median(pair));
}

}  // namespace
}  // namespace vitrail::test

int main(int argc, char** argv) {
  using namespace vitrail;
  using namespace vitrail::test;
  const int spp = argc > 2 && std::string(argv[1]) == "--spp" ? std::atoi(argv[2]) : 8;
  const TemporaryDirectory directory;
  const Scene scene = bench_scene();
  for (const std::uint32_t domains : {1u, 64u}) {
    PartitionOptions options;
    options.domains = domains;
    const PartitionStats stats = partition(scene, directory / fmt::format("{}.vit", domains), options);
    fmt::print("{} triangles, {} domains, {:.1f} bytes a triangle\n", stats.input_triangles, stats.domains,
               static_cast<double>(stats.bundle_bytes) / static_cast<double>(stats.input_triangles));
  }
  against_the_bare_intersector(directory / "1.vit", std::min(spp, 8));
  domains_and_ranks(directory, spp);
  fmt::print("wire: path {} B, shadow {} B\n", sizeof(RayRecord), sizeof(ShadowRecord));
}
