// SPDX-License-Identifier: Apache-2.0
#include "partitioner/object_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "partitioner/cutting/kd_plan.h"
#include "partitioner/cutting/work_estimate.h"
#include "partitioner/memory_plan.h"
#include "partitioner/spilling/spill_scene.h"
#include "partitioner/writing/write_objects.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::uint32_t most_domains = 65535;  // farm/: 16 bits in a ray's record

std::uint64_t object_bytes(const Manifest& m, std::span<const InstanceRef> instances) {
  std::uint64_t bytes = 0;
  for (const std::uint32_t object : needed_objects(m, instances)) bytes += m.objects[object].bytes;
  return bytes + bytes / 4;  // the domains will be cut by another sample
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
      most = std::max(most, object_bytes(world.manifest, dealer.in(leaf.cell)));
    return most + static_cast<std::uint64_t>(own_bytes / count);
  };
  for (;;) {
    const std::uint64_t most = most_bytes(domains);
    if (most <= domain_bytes) return domains;
    if (domains == most_domains)
      throw UsageError(fmt::format(
          "--domain-bytes {} is too little for a domain and the objects that it has instances of: even {} "
          "domains would take up to {}K each, so it has to be more than that",
          domain_bytes, most_domains, (most + 1023) / 1024));
    const double growth =
        std::clamp(static_cast<double>(most) / static_cast<double>(domain_bytes), 1.25, 2.0);
    domains = static_cast<std::uint32_t>(std::min<double>(std::ceil(domains * growth), most_domains));
  }
}

}  // namespace vitrail
