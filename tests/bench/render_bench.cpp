// SPDX-License-Identifier: Apache-2.0
// What a whole render costs beside the intersections it cannot do without, scene by scene; what sub-domains
// cost, what a second rank gains. All are ratios within one run. Seconds on a shared machine mean little by
// themselves.
//
//   bench_render [--spp N]
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bundle/loaded_domain.h"
#include "partitioner/partition.h"
#include "tests/bench/render_scenes.h"
#include "tests/bench/timing.h"
#include "tests/support/command.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"
#include "tracer/transport/waves/tracer.h"

namespace vitrail::test {
namespace {

// Records the calls of the intersector, so that the same rays can be traced again without anything else.
struct Recording {
  struct Call {
    std::size_t first, count;  // among the rays
    bool occluded, many;       // which function of KernelFunctions
  };
  std::vector<Call> calls;
  std::vector<RayConstants> rays;
  std::vector<float> ends;  // of shadow rays; others have 0

  void add(const RayConstants* of, const float* tmax, std::size_t count, bool many) {
    calls.push_back({rays.size(), count, tmax != nullptr, many});
    rays.insert(rays.end(), of, of + count);
    tmax ? ends.insert(ends.end(), tmax, tmax + count) : ends.insert(ends.end(), count, 0.0f);
  }
};
Recording recording;
const KernelFunctions* recorded_kernel = nullptr;

KernelFunctions recorder() {
  recorded_kernel = &best_kernel();
  KernelFunctions k = *recorded_kernel;
  k.tree_closest = [](const BvhNode* nodes, const Cluster* clusters, const RayConstants& ray, Hit& hit) {
    recording.add(&ray, nullptr, 1, false);
    recorded_kernel->tree_closest(nodes, clusters, ray, hit);
  };
  k.tree_occluded = [](const BvhNode* nodes, const Cluster* clusters, const RayConstants& ray, float tmax) {
    recording.add(&ray, &tmax, 1, false);
    return recorded_kernel->tree_occluded(nodes, clusters, ray, tmax);
  };
  k.domain_closest = [](const DomainView& domain, const RayConstants& ray, Hit& hit) {
    recording.add(&ray, nullptr, 1, false);
    recorded_kernel->domain_closest(domain, ray, hit);
  };
  k.domain_occluded = [](const DomainView& domain, const RayConstants& ray, float tmax) {
    recording.add(&ray, &tmax, 1, false);
    return recorded_kernel->domain_occluded(domain, ray, tmax);
  };
  k.node_closest = [](const BvhNode& node, const Cluster* clusters, const RayConstants* rays,
                      Hit* const* hits, std::size_t count) {
    recording.add(rays, nullptr, count, true);
    recorded_kernel->node_closest(node, clusters, rays, hits, count);
  };
  k.node_occluded = [](const BvhNode& node, const Cluster* clusters, const RayConstants* rays,
                       const float* tmax, bool* blocked, std::size_t count) {
    recording.add(rays, tmax, count, true);
    recorded_kernel->node_occluded(node, clusters, rays, tmax, blocked, count);
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
  constexpr std::size_t most = 64;  // rays a call
  std::array<Hit, most> hits;
  std::array<Hit*, most> places;
  for (std::size_t i = 0; i < most; ++i) places[i] = &hits[i];
  std::array<bool, most> blocked;
  std::uint64_t met = 0;
  const double start = cpu_seconds();
  for (const Recording::Call& call : recording.calls) {
    const RayConstants* const rays = &recording.rays[call.first];
    const float* const ends = &recording.ends[call.first];
    if (call.occluded) {
      if (call.many)
        kernel.occluded_of_many(view, rays, ends, blocked.data(), call.count);
      else
        blocked[0] = kernel.occluded(view, *rays, *ends);
      for (std::size_t i = 0; i < call.count; ++i) met += blocked[i];
      continue;
    }
    std::fill_n(hits.begin(), call.count, Hit{});
    if (call.many)
      kernel.closest_of_many(view, rays, places.data(), call.count);
    else
      kernel.closest(view, *rays, hits[0]);
    for (std::size_t i = 0; i < call.count; ++i) met += hits[i].triangle != no_triangle;
  }
  const double seconds = cpu_seconds() - start;
  if (met == 0) fmt::print("no ray hit anything\n");
  return seconds;
}

// Millions of rays a second of a processor: of a whole render in one domain, and of the intersector alone
// with the same rays.
void against_the_bare_intersector(const std::string& name, const std::filesystem::path& bundle, int spp) {
  const RenderScene scene(read_manifest(bundle), bundle, 1 << 30, 0);
  const auto domain = load_domain(scene.manifest, bundle, 0);
  const KernelFunctions recording_kernel = recorder();
  recording = {};
  trace_all(scene, &domain->view(), recording_kernel, spp);
  std::vector<double> whole, bare;
  for (int i = 0; i < 5; ++i) {
    whole.push_back(trace_all(scene, &domain->view(), best_kernel(), spp));
    bare.push_back(replay(domain->view()));
  }
  const double millions = static_cast<double>(recording.rays.size()) * 1e-6;
  fmt::print("{:14} {:7.3f} {:7.3f} {:7.3f}\n", name, millions / median(whole), millions / median(bare),
             median(bare) / median(whole));
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
  fmt::print("Mray/CPU-s       whole    bare   ratio   (target >= 0.5)\n");
  for (const auto& [name, scene] : render_scenes(directory.path())) {
    partition(scene, directory / "scene.vit", {});
    against_the_bare_intersector(name, directory / "scene.vit", spp);
  }
  const Scene scene = million_room();
  for (const std::uint32_t domains : {1u, 64u}) {
    PartitionOptions options;
    options.domains = domains;
    const PartitionStats stats = partition(scene, directory / fmt::format("{}.vit", domains), options);
    fmt::print("{} triangles, {} domains, {:.1f} bytes a triangle\n", stats.input_triangles, stats.domains,
               static_cast<double>(stats.bundle_bytes) / static_cast<double>(stats.input_triangles));
  }
  against_the_bare_intersector("million room", directory / "1.vit", std::min(spp, 8));
  domains_and_ranks(directory, spp);
  fmt::print("wire: path {} B, shadow {} B\n", sizeof(RayRecord), sizeof(ShadowRecord));
}
