// SPDX-License-Identifier: Apache-2.0
#include "partitioner/least_memory.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "images/image_files.h"
#include "partitioner/memory_ledger.h"
#include "partitioner/placing/plan_scene.h"
#include "partitioner/writing/write_objects.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

// Of a picture: a PNG states them; others have at most so many a byte.
std::uint64_t most_pixels(const std::string& file) {
  constexpr std::uint64_t a_byte = 16;
  std::array<unsigned char, 24> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(head.data()), head.size());
  const auto number = [&](std::size_t at) {
    return std::uint64_t{head[at]} << 24 | std::uint64_t{head[at + 1]} << 16 |
           std::uint64_t{head[at + 2]} << 8 | head[at + 3];
  };
  if (in && head[1] == 'P' && head[2] == 'N' && head[3] == 'G') return number(16) * number(20);
  std::error_code unknown;
  const std::uint64_t bytes = std::filesystem::file_size(file, unknown);
  return unknown ? 0 : a_byte * bytes;
}

// While the largest image is baked, by rows: measured. 0 where the scene has none.
std::uint64_t baking_bytes(const Scene& scene) {
  constexpr std::uint64_t least = 1 << 20, a_pixel = 64, most = 31 << 20;
  std::uint64_t bytes = 0;
  const auto look_at = [&](const std::string& file) {
    bytes = std::max(bytes, std::min(least + a_pixel * std::min(most_pixels(file), most), most));
  };
  for (const Texture& texture : scene.textures)
    if (const auto* image = std::get_if<ImageTexture>(&texture.model)) look_at(image->filename);
  for (const Light& light : scene.lights)
    std::visit(
        [&](const auto& l) {
          if constexpr (requires { l.filename; })
            if (!l.filename.empty()) look_at(l.filename);
        },
        light.model);
  return bytes;
}

}  // namespace

std::uint64_t most_object_bytes(std::uint64_t domain_bytes) {
  constexpr std::uint64_t by_default = 64 << 20, least = 64 << 10;
  return domain_bytes > 0 ? std::max(domain_bytes / 4, least) : by_default;
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

std::uint64_t least_memory(const Scene& scene, const PartitionOptions& options) {
  ScenePlan plan = plan_scene(scene);
  if (options.flatten) flatten(plan);
  Manifest m;
  m.requirements.uv = !scene.textures.empty();
  m.requirements.shading_normals =
      std::ranges::any_of(scene.meshes, [](const TriangleMesh& mesh) { return has_normals(mesh); });
  MemoryNeeds needs = needs_of(scene, options);
  needs.baking_bytes = baking_bytes(scene);
  needs.image_library |= needs.baking_bytes > 0;
  for (const Placement& p : plan.scene.placements) needs.triangles += triangles_of(*p.mesh);
  const auto shines = [](const Placement& p) { return p.shape->area_light.has_value(); };
  std::uint64_t shining = 0;
  for (const Placement& p : plan.scene.placements) shining += shines(p) ? triangles_of(*p.mesh) : 0;
  for (const Placement& p : expanded(plan, shines)) shining += triangles_of(*p.mesh);
  needs.scene_bytes += shining * sizeof(EmissiveTriangle);
  needs.instance_bytes = plan.scene.uses.size() * bytes_of_reference;
  for (const QuadricRun& run : plan.scene.runs)
    needs.quadrics += run.places->size() * (is_curve(*run.quadric) ? 3 : 1);
  for (const Assembly& object : plan.objects)
    needs.object_bytes =
        std::max(needs.object_bytes, bytes_in_work(m, object, most_object_bytes(options.domain_bytes)));
  return least_budget(m, needs);
}

}  // namespace vitrail
