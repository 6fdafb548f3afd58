// SPDX-License-Identifier: Apache-2.0
#include "partitioner/object_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "partitioner/cutting/kd_plan.h"
#include "partitioner/cutting/work_estimate.h"
#include "partitioner/memory_plan.h"
#include "partitioner/spilling/spill_scene.h"
#include "partitioner/writing/object_groups.h"
#include "partitioner/writing/write_objects.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::uint32_t most_domains = 65535;  // farm/: 16 bits in a ray's record

// Throws UsageError where an object with all that it needs takes more by itself.
void require_room_for_each(const Manifest& m, const SceneInstances& instances, std::uint64_t domain_bytes) {
  std::vector<bool> seen(m.objects.size());
  std::uint64_t most = 0;
  for (const InstanceRef& ref : instances.refs) {
    if (!seen[ref.object]) most = std::max(most, bytes_with_inner(m.objects, ref.object));
    seen[ref.object] = true;
  }
  if (most > domain_bytes)
    throw UsageError(
        fmt::format("--domain-bytes {} is too little for an object with the instances in it, which takes {}K",
                    domain_bytes, (most + 1023) / 1024));
}

}  // namespace

std::uint32_t domains_within(const World& world, const SceneInstances& instances, std::uint64_t domain_bytes,
                             std::uint32_t domains) {
  const std::vector<Bounds3f> boxes = sample_of(world, instances);
  const std::vector<Item> items = WorkEstimate().items(boxes);
  Bounds3f bounds;
  for (const Bounds3f& b : boxes) extend(bounds, b);
  const InstanceDealer dealer(instances.refs, bounds);
  const double own_bytes = bytes_of_a_triangle(world.manifest) * static_cast<double>(world.own_triangles);
  const auto most_bytes = [&](std::uint32_t count) {
    std::vector<KdNode> nodes(count - 1);
    const double share = static_cast<double>(items.size()) / count;
    const double rate =
        static_cast<double>(items.size()) /
        static_cast<double>(world.own_triangles + instances.refs.size() + instances.in_runs());
    const KdPlan plan = plan_kd_tree(items, {bounds, 0, 0, count}, {share, 1, false, rate}, nodes);
    std::uint64_t most = 0;
    for (const Subtree& leaf : plan.leaves)
      most = std::max(most, bytes_of_objects(world.manifest, dealer.in(leaf.cell)));
    most += most / 4;  // the domains will be cut by another sample
    return most + static_cast<std::uint64_t>(own_bytes / count);
  };
  require_room_for_each(world.manifest, instances, domain_bytes);
  // More domains help where they have fewer objects. Where four times as many do not halve what one needs,
  // domains that share a cell part its objects (divide_cell.h).
  std::uint64_t before_bytes = most_bytes(domains);
  for (std::uint64_t more = 4 * std::uint64_t{domains}; before_bytes > domain_bytes && more <= most_domains;
       more *= 4) {
    const std::uint64_t bytes = most_bytes(static_cast<std::uint32_t>(more));
    if (2 * bytes > before_bytes) break;
    domains = static_cast<std::uint32_t>(more);
    before_bytes = bytes;
  }
  return domains;
}

}  // namespace vitrail
