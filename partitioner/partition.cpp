// SPDX-License-Identifier: Apache-2.0
#include "partitioner/partition.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <iterator>
#include <mutex>
#include <numeric>
#include <stdexcept>

#include "partitioner/bundle_directory.h"
#include "partitioner/choose_plane.h"
#include "partitioner/write_domain.h"
#include "partitioner/write_objects.h"

namespace vitrail {

namespace {

constexpr std::uint64_t default_domain_bytes = 64ull << 20;
constexpr std::uint32_t most_domains = 999'999;  // six digits in a file name
// Bytes of a triangle in a domain file: nodes, clusters and pieces, and its three normals
// (docs/partitioning.md).
constexpr double bytes_per_triangle = 62, bytes_per_normals = 16, bytes_per_uvs = 32,
                 bytes_per_attribute = 48;
// No domain should have more than this many times its even share of triangles.
constexpr double most_load = 1.2;

using Clock = std::chrono::steady_clock;

double cpu_seconds() {
  rusage u{};
  ::getrusage(RUSAGE_SELF, &u);
  const auto seconds = [](timeval t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(u.ru_utime) + seconds(u.ru_stime);
}

std::uint64_t peak_rss_bytes() {
  rusage u{};
  ::getrusage(RUSAGE_SELF, &u);
  return static_cast<std::uint64_t>(u.ru_maxrss) * 1024;
}

std::uint32_t number_of_domains(const FlatScene& scene, const PartitionOptions& options) {
  double domains = options.domains;
  if (options.domains == 0) {
    const double bytes =
        static_cast<double>(options.domain_bytes ? options.domain_bytes : default_domain_bytes);
    const double each = bytes_per_triangle + (scene.normals.empty() ? 0 : bytes_per_normals) +
                        (scene.uvs.empty() ? 0 : bytes_per_uvs) +
                        bytes_per_attribute * static_cast<double>(scene.attributes.size());
    domains = std::max(1.0, std::ceil(static_cast<double>(scene.triangles.size()) * each / bytes));
  }
  if (domains > most_domains)
    throw UsageError(fmt::format("{:.0f} domains are asked for; the most is {}", domains, most_domains));
  return static_cast<std::uint32_t>(domains);
}

// Part of the kd-tree to be made: `leaves` domains from `first_domain` on, their inner nodes from `node` on.
// Nodes are numbered in preorder, so that every subtree knows its numbers beforehand and threads cannot
// change them.
struct Subtree {
  Bounds3f cell;
  std::uint32_t node = 0, first_domain = 0, leaves = 1;
};

// The ids of the scene's instances.
std::vector<IdRange> ids_of(const ScenePlan& plan) {
  std::vector<IdRange> ranges;
  for (const ObjectUse& use : plan.scene.uses)
    ranges.push_back({use.first_triangle, plan.objects[use.object].triangles});
  return ranges;
}

void add_stand_ins(const std::vector<InstanceRef>& instances, std::vector<Triangle>& triangles) {
  for (const InstanceRef& ref : instances) {
    const Bounds3f box = box_of(ref);
    triangles.push_back({box.lower, box.upper, box.upper});
  }
}

class Divider {
 public:
  // The instances have stand-ins behind the scene's triangles, so that cuts heed them.
  Divider(FlatScene& scene, const InstanceDealer& instances, std::filesystem::path bundle,
          std::uint32_t domains, const std::function<void(double, const char*)>& progress)
      : scene_(scene),
        instances_(instances),
        bundle_(std::move(bundle)),
        progress_(progress),
        census_(scene.manifest.triangles, ids_of(scene.plan)) {
    scene_.manifest.domains.resize(domains);
    scene_.manifest.kd_nodes.resize(domains - 1);
    most_triangles_ = most_load * static_cast<double>(scene.triangles.size()) / domains;
  }

  void divide(CellContent content, const Subtree& s) {
    if (s.leaves == 1) return finish(content, s);
    const std::uint32_t below = s.leaves / 2, above = s.leaves - below;
    const Plane plane = choose(content, s, below, above);
    const std::uint32_t below_node = s.node + 1, above_node = s.node + below;
    const auto child = [](std::uint32_t leaves, std::uint32_t node, std::uint32_t domain) {
      return leaves == 1 ? KdNode::leaf_bit | domain : node;
    };
    scene_.manifest.kd_nodes[s.node] = {plane.split, static_cast<std::uint32_t>(plane.axis),
                                        child(below, below_node, s.first_domain),
                                        child(above, above_node, s.first_domain + below)};
    auto sides = cut(content, scene_.triangles, plane);
    content = {};
    Subtree low_tree{s.cell, below_node, s.first_domain, below};
    Subtree high_tree{s.cell, above_node, s.first_domain + below, above};
    low_tree.cell.upper[plane.axis] = high_tree.cell.lower[plane.axis] = plane.split;
    tbb::parallel_invoke([&] { divide(std::move(sides.first), low_tree); },
                         [&] { divide(std::move(sides.second), high_tree); });
  }

  CensusResult census() const { return census_.result(); }

 private:
  // A cell in which nothing can be parted is halved: some of its domains stay empty.
  Plane choose(const CellContent& content, const Subtree& s, std::uint32_t below, std::uint32_t above) const {
    const double spare = most_triangles_ * s.leaves / std::max(1.0, static_cast<double>(content.size()));
    const double tolerance = std::max(0.01, std::pow(spare, 1.0 / std::bit_width(s.leaves - 1)) - 1);
    if (const auto plane = choose_plane(content, scene_.triangles, {below, above, tolerance})) return *plane;
    if (s.cell.empty()) return {};
    const Vector3f e = extent(s.cell);
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    return {axis, std::midpoint(s.cell.lower[axis], s.cell.upper[axis])};
  }

  void finish(const CellContent& content, const Subtree& s) {
    scene_.manifest.domains[s.first_domain] = write_domain(
        scene_, without_stand_ins(content), instances_.in(s.cell), bundle_, s.first_domain, census_);
    const std::lock_guard lock(mutex_);
    const auto all = static_cast<double>(scene_.manifest.domains.size());
    if (progress_) progress_(0.2 + 0.8 * ++finished_ / all, "cutting and writing domains");
  }

  CellContent without_stand_ins(const CellContent& content) const {
    if (scene_.triangles.size() == scene_.ids.size()) return content;
    CellContent own;
    std::ranges::copy_if(content.whole, std::back_inserter(own.whole),
                         [&](std::uint32_t i) { return i < scene_.ids.size(); });
    for (Piece p : content.pieces) {
      if (p.triangle >= scene_.ids.size()) continue;
      const auto polygon = content.polygon(p);
      p.first_vertex = static_cast<std::uint32_t>(own.piece_vertices.size());
      own.piece_vertices.insert(own.piece_vertices.end(), polygon.begin(), polygon.end());
      own.pieces.push_back(p);
    }
    return own;
  }

  FlatScene& scene_;
  const InstanceDealer& instances_;
  std::filesystem::path bundle_;
  const std::function<void(double, const char*)>& progress_;
  Census census_;
  double most_triangles_ = 0;
  std::mutex mutex_;
  double finished_ = 0;
};

std::uint64_t directory_bytes(const std::filesystem::path& directory) {
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

PartitionStats statistics(const Manifest& m, const CensusResult& census,
                          const std::filesystem::path& bundle) {
  PartitionStats s;
  s.input_triangles = m.triangles;
  s.cut_triangles = census.cut_triangles;
  s.pieces = census.pieces;
  s.domains = m.domains.size();
  s.triangles_min = m.domains[0].triangles;
  std::uint64_t sum = 0;
  for (const DomainInfo& d : m.domains) {
    s.instances += d.instances;
    s.triangles_min = std::min(s.triangles_min, d.triangles);
    s.triangles_max = std::max(s.triangles_max, d.triangles);
    sum += d.triangles;
  }
  s.triangles_mean = static_cast<double>(sum) / static_cast<double>(m.domains.size());
  s.objects = m.objects.size();
  s.bundle_bytes = directory_bytes(bundle);
  s.duplicates = census.duplicates;
  s.area_error = census.area_error;
  return s;
}

PartitionStats write_bundle(const Scene& scene, const std::filesystem::path& bundle,
                            const PartitionOptions& options,
                            const std::function<void(double, const char*)>& progress) {
  if (progress) progress(0, "placing triangles");
  FlatScene flat = flatten(scene, bundle, {!options.flatten, options.everything});
  const std::uint64_t most_bytes = options.domain_bytes ? options.domain_bytes : default_domain_bytes;
  const InstanceDealer instances(write_objects(flat, bundle, most_bytes),
                                 static_cast<float>(padding(flat.manifest)));
  add_stand_ins(instances.all(), flat.triangles);
  const std::uint32_t domains = number_of_domains(flat, options);
  if (progress) progress(0.2, "cutting and writing domains");
  Divider divider(flat, instances, bundle, domains, progress);
  CellContent all;
  all.whole.resize(flat.triangles.size());
  std::iota(all.whole.begin(), all.whole.end(), 0u);
  divider.divide(std::move(all), {flat.manifest.bounds, 0, 0, domains});
  const CensusResult census = divider.census();
  if (census.lost != 0)
    throw std::logic_error(fmt::format("partitioning lost {} triangles; please report this", census.lost));
  flat.manifest.cut_triangles = census.cut_triangles;
  write_manifest(bundle, flat.manifest);
  return statistics(flat.manifest, census, bundle);
}

}  // namespace

PartitionStats partition(const Scene& scene, const std::filesystem::path& out,
                         const PartitionOptions& options,
                         const std::function<void(double, const char*)>& progress) {
  const auto start = Clock::now();
  const double cpu_start = cpu_seconds();
  BundleDirectory directory(out);
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  PartitionStats stats =
      arena.execute([&] { return write_bundle(scene, directory.path(), options, progress); });
  directory.commit();
  stats.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  stats.cpu_s = cpu_seconds() - cpu_start;
  stats.peak_rss_bytes = peak_rss_bytes();
  return stats;
}

}  // namespace vitrail
