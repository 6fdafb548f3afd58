// SPDX-License-Identifier: Apache-2.0
#include "partitioner/divide_cell.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>

#include "partitioner/cutting/shared_cell.h"
#include "partitioner/memory_plan.h"
#include "partitioner/writing/object_groups.h"
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

// Domains that share the cell with the one of the plan, which has the triangles. Each has objects that fit
// into memory together.
SharedCell write_sharers(std::vector<std::vector<InstanceRef>> groups, const Subtree& leaf,
                         const DomainWriter& writer) {
  Manifest& m = writer.manifest;
  SharedCell cell{leaf.first_domain, {}, {}, {}};
  std::vector<SharedBox> boxes;
  for (std::vector<InstanceRef>& group : groups) {
    const auto index = static_cast<std::uint32_t>(cell.numbers.size());
    for (const InstanceRef& ref : group) boxes.push_back({padded_box(ref), index});
    const std::uint32_t number = writer.shared.take_number(static_cast<std::uint32_t>(m.domains.size()));
    cell.numbers.push_back(number);
    cell.infos.push_back(write_domain(m, {}, {}, std::move(group), writer.store, number, writer.census));
  }
  const auto own = static_cast<std::uint32_t>(groups.size());
  cell.tree = tree_of_shared(leaf.cell, boxes, own, max_kd_depth - leaf.depth - 1);
  return cell;
}

void write_cell(const NumberedTriangles& triangles, const CellContent& content, const Subtree& leaf,
                const DomainWriter& writer) {
  Manifest& m = writer.manifest;
  std::vector<InstanceRef> instances = writer.instances.in(leaf.cell);
  // Where places take more than the objects, smaller cells help, and these are a matter of the plan.
  if (writer.domain_bytes > 0 && 2 * bytes_of_objects(m, instances) > writer.domain_bytes) {
    const double own_bytes = bytes_of_a_triangle(m) * static_cast<double>(content.size());
    std::vector<std::vector<InstanceRef>> groups =
        groups_by_objects(m.objects, instances, writer.domain_bytes, static_cast<std::uint64_t>(own_bytes));
    const int levels = max_kd_depth - leaf.depth - 2;  // for the others
    if (groups.size() > 1 && levels >= static_cast<int>(std::bit_width(groups.size()))) {
      std::erase_if(groups, [](const auto& group) { return group.empty(); });
      writer.shared.add(write_sharers(std::move(groups), leaf, writer));
      instances.clear();
    }
  }
  m.domains[leaf.first_domain] = write_domain(m, triangles, content, std::move(instances), writer.store,
                                              leaf.first_domain, writer.census);
}

}  // namespace

std::uint32_t SharedCells::take_number(std::uint32_t planned) {
  const std::lock_guard lock(mutex_);
  return planned + taken_++;
}
void SharedCells::add(SharedCell cell) {
  const std::lock_guard lock(mutex_);
  cells_.push_back(std::move(cell));
}
std::vector<SharedCell> SharedCells::take() { return std::move(cells_); }

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
        write_cell(triangles, content, plan.leaves[leaf], writer);
        writer.wrote(content.size());
      }));
}

}  // namespace vitrail
