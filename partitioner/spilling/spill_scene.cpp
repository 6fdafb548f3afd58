// SPDX-License-Identifier: Apache-2.0
#include "partitioner/spilling/spill_scene.h"

#include <algorithm>
#include <numeric>

#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

class Sampler {
 public:
  Sampler(const World& world, int shift) : world_(world), shift_(shift) {}

  void add(const Placement& p) {
    const TriangleMesh& mesh = *p.mesh;
    const auto seed = static_cast<std::uint64_t>(&p - world_.placements.data());
    if (mesh.deferred) {
      for (const auto& s : mesh.deferred->sample)
        if (is_chosen(seed, s.triangle, shift_ - mesh.deferred->sample_shift)) add(p, s.vertices);
      return;
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!is_chosen(seed, i, shift_)) continue;
      const auto& corners = mesh.triangles[i];
      add(p, {mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]]});
    }
  }
  std::vector<Bounds3f> take() { return std::move(sample_); }

 private:
  static bool is_chosen(std::uint64_t seed, std::uint64_t triangle, int shift) {
    return (mixed(seed + 1, triangle) & ((std::uint64_t{1} << shift) - 1)) == 0;
  }
  void add(const Placement& p, const std::array<Point3f, 3>& vertices) {
    Bounds3f b;
    for (const Point3f& v : vertices) extend(b, sampled(p, transform_point(p.to_world, cast<double>(v))));
    sample_.push_back(b);
  }

  Point3f sampled(const Placement& p, Point3d at) const {
    if (!p.standing) return cast<float>(at - world_.manifest.offset);
    return placed(p.standing->to_bundle, cast<float>(at - p.standing->centre));
  }

  const World& world_;
  int shift_;
  std::vector<Bounds3f> sample_;
};

}  // namespace

std::vector<Bounds3f> sample_of(const World& world, const SceneInstances& instances, std::uint64_t most) {
  int shift = 0;
  while (((world.own_triangles + instances.in_runs()) >> shift) > most) ++shift;
  for (const Placement& p : world.placements)
    if (p.mesh->deferred) shift = std::max(shift, p.mesh->deferred->sample_shift);
  Sampler sampler(world, shift);
  for (const Placement& p : world.placements) sampler.add(p);
  std::vector<Bounds3f> sample = sampler.take();
  const std::size_t chosen = sample.size();
  for (std::size_t i = 0; i < instances.refs.size(); ++i)
    if (world.own_triangles == 0 || mixed(2, i) % world.own_triangles < chosen)
      sample.push_back(box_of(instances.refs[i]));
  instances.for_each_of_runs([&](const InstanceRef& ref) {
    if ((mixed(3, ref.first_triangle) & ((std::uint64_t{1} << shift) - 1)) == 0)
      sample.push_back(box_of(ref));
  });
  return sample;
}

void spill_scene(const World& world, const KdPlan& plan, std::uint64_t load_bytes, BucketSpill& spill,
                 SceneTally& tally, const std::function<void(std::uint64_t)>& placed) {
  const PlacementRule rule = world.rule();
  place_scene(world, load_bytes, [&](const Block& block) {
    const std::size_t count = block.end - block.begin;
    NumberedTriangles triangles{make_room(rule, count), std::vector<std::uint32_t>(count)};
    std::iota(triangles.ids.begin(), triangles.ids.end(),
              static_cast<std::uint32_t>(block.placement.first_triangle + block.begin));
    block.placer.place(block.begin, block.end, triangles, 0);
    tally.add(block, triangles, 0);
    std::vector<CellContent> parts(plan.leaves.size());
    route(triangles.triangles, 0, static_cast<std::uint32_t>(count), {}, plan.nodes, parts);
    for (std::size_t bucket = 0; bucket < parts.size(); ++bucket) spill.add(bucket, triangles, parts[bucket]);
    placed(count);
  });
  spill.flush();
}

}  // namespace vitrail
