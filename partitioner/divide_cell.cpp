// SPDX-License-Identifier: Apache-2.0
#include "partitioner/divide_cell.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

// Counts of a domain's triangles are then known to about 2 %.
constexpr std::uint64_t samples_per_domain = 2048, least_samples = 65536;

Bounds3f box_of(const Triangle& t) {
  Bounds3f b;
  for (const Point3f& v : t) extend(b, v);
  return b;
}

Bounds3f box_of(std::span<const Point3d> polygon) {
  Bounds3f b;
  for (const Point3d& v : polygon) extend(b, cast<float>(v));
  return b;
}

std::vector<Bounds3f> sample_of(const NumberedTriangles& triangles, const CellContent& cut,
                                std::uint32_t domains) {
  const std::uint64_t count = triangles.triangles.size();
  const std::uint64_t wanted = std::max(least_samples, samples_per_domain * domains);
  int shift = 0;
  while ((count >> shift) > wanted) ++shift;
  std::vector<Bounds3f> sample;
  auto piece = cut.pieces.begin();
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool is_piece = piece != cut.pieces.end() && piece->triangle == i;
    if ((mixed(1, i) & ((std::uint64_t{1} << shift) - 1)) == 0)
      sample.push_back(is_piece ? box_of(cut.polygon(*piece)) : box_of(triangles.triangles[i]));
    if (is_piece) ++piece;
  }
  return sample;
}

using Parts = std::vector<std::vector<CellContent>>;  // [block][leaf]

Parts route_all(const NumberedTriangles& triangles, const CellContent& cut, const KdPlan& plan) {
  constexpr std::size_t least_block = 32768;
  const std::size_t count = triangles.triangles.size();
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const std::size_t blocks = std::clamp<std::size_t>(count / least_block, 1, 4 * threads);
  Parts parts(blocks, std::vector<CellContent>(plan.leaves.size()));
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    route(triangles.triangles, static_cast<std::uint32_t>(b * count / blocks),
          static_cast<std::uint32_t>((b + 1) * count / blocks), cut, plan.nodes, parts[b]);
  });
  return parts;
}

CellContent gather(Parts& parts, std::size_t leaf) {
  CellContent all = std::move(parts[0][leaf]);
  for (std::size_t b = 1; b < parts.size(); ++b) {
    all.append(parts[b][leaf]);
    parts[b][leaf] = {};
  }
  return all;
}

}  // namespace

void divide_cell(const NumberedTriangles& triangles, const CellContent& cut, const Subtree& subtree,
                 const DomainWriter& writer) {
  Manifest& m = writer.manifest;
  std::vector<Bounds3f> sample = sample_of(triangles, cut, subtree.domains);
  const std::size_t chosen = sample.size(), all = triangles.triangles.size();
  // An instance counts as a triangle.
  const std::vector<InstanceRef> instances = writer.instances.in(subtree.cell);
  for (std::size_t i = 0; i < instances.size(); ++i)
    if (all == 0 || mixed(2, i) % all < chosen) sample.push_back(box_of(instances[i]));
  // Of a sample of this rate all that the scene has would be so many in each domain.
  const double rate =
      static_cast<double>(sample.size()) / std::max(1.0, static_cast<double>(all + instances.size()));
  const double share = rate * static_cast<double>(writer.items) / static_cast<double>(m.domains.size());
  const KdPlan plan =
      plan_kd_tree(writer.work.items(sample), subtree, {share, 1, writer.median, rate}, m.kd_nodes);
  Parts parts = route_all(triangles, cut, plan);
  std::size_t next = 0;
  tbb::parallel_pipeline(
      writer.at_once,
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
        if (next == plan.leaves.size()) flow.stop();
        return next++;
      }) & tbb::make_filter<std::size_t, void>(tbb::filter_mode::parallel, [&](std::size_t leaf) {
        const CellContent content = gather(parts, leaf);
        const std::uint32_t domain = plan.leaves[leaf].first_domain;
        m.domains[domain] = write_domain(m, triangles, content, writer.instances.in(plan.leaves[leaf].cell),
                                         writer.store, domain, writer.census);
        writer.wrote(content.size());
      }));
}

}  // namespace vitrail
