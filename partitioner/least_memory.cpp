// SPDX-License-Identifier: Apache-2.0
#include "partitioner/least_memory.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "images/image_files.h"
#include "partitioner/appearance/baking_memory.h"
#include "partitioner/memory_ledger.h"
#include "partitioner/placing/plan_scene.h"
#include "partitioner/writing/write_objects.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

std::uint64_t most_object_bytes(std::uint64_t domain_bytes) {
  constexpr std::uint64_t by_default = 64 << 20, least = 64 << 10;
  return domain_bytes > 0 ? std::max(domain_bytes / 4 * 3, least) : by_default;
}

MemoryNeeds needs_of(const Scene& scene, const PartitionOptions& options) {
  MemoryNeeds needs{.budget_bytes = options.memory_bytes,
                    .scene_bytes = ledger_of(scene).all(),
                    .domains = options.domains,
                    .domain_bytes = options.domain_bytes,
                    .image_library = image_library_is_loaded(),
                    .share = options.memory_share,
                    .threads = tbb::this_task_arena::max_concurrency()};
  std::uint64_t in_memory = 0;
  for (const TriangleMesh& mesh : scene.meshes) {
    in_memory += bytes_of(mesh);
    if (!mesh.deferred) continue;
    needs.mesh_bytes += mesh.deferred->bytes;
    needs.largest_mesh = std::max(needs.largest_mesh, mesh.deferred->bytes);
  }
  needs.scene_bytes -= in_memory;
  needs.mesh_bytes += in_memory;
  if (in_memory > meshes_within(needs.budget_bytes)) needs.held_meshes = in_memory;
  return needs;
}

std::uint64_t least_memory(const Scene& scene, const PartitionOptions& options, std::uint64_t more_bytes) {
  ScenePlan plan = plan_scene(scene);
  if (options.flatten) flatten(plan);
  Manifest m;
  m.requirements.uv = !scene.textures.empty();
  m.requirements.shading_normals =
      std::ranges::any_of(scene.meshes, [](const TriangleMesh& mesh) { return has_normals(mesh); });
  std::set<std::string_view> attributes;
  for (const Texture& texture : scene.textures)
    if (const auto* attribute = std::get_if<MeshAttributeTexture>(&texture.model))
      attributes.insert(attribute->name);
  m.attributes = static_cast<std::uint32_t>(attributes.size());
  MemoryNeeds needs = needs_of(scene, options);
  const BakingMemory baking = baking_memory(scene, needs.threads);
  needs.baking_bytes = baking.bytes;
  needs.image_library |= baking.image_library;
  for (const Placement& p : plan.scene.placements) needs.triangles += triangles_of(*p.mesh);
  const auto shines = [](const Placement& p) { return p.shape->area_light.has_value(); };
  std::uint64_t shining = 0;
  for (const Placement& p : plan.scene.placements) shining += shines(p) ? triangles_of(*p.mesh) : 0;
  for (const Placement& p : expanded(plan, shines)) shining += triangles_of(*p.mesh);
  needs.scene_bytes += more_bytes + shining * sizeof(EmissiveTriangle);
  needs.instance_bytes = plan.scene.uses.size() * bytes_of_reference;
  for (const QuadricRun& run : plan.scene.runs)
    needs.quadrics += run.places->size() * (is_curve(*run.quadric) ? 3 : 1);
  for (const Assembly& object : plan.objects)
    needs.object_bytes =
        std::max(needs.object_bytes, bytes_in_work(m, object, most_object_bytes(options.domain_bytes)));
  return least_budget(m, needs);
}

}  // namespace vitrail
