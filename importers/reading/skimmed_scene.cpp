// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/skimmed_scene.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

TriangleMesh counted_mesh(std::uint64_t triangles, std::uint64_t bytes, bool has_normals) {
  const auto counted = std::make_shared<DeferredMesh>();
  counted->triangles = std::max<std::uint64_t>(triangles, 1);
  counted->bytes = bytes;
  counted->has_normals = has_normals;
  counted->bounds = Bounds3f{{0, 0, 0}, {1, 1, 1}};
  TriangleMesh mesh;
  mesh.deferred = counted;
  return mesh;
}

void sum_up_meshes(SkimmedScene& skimmed) {
  std::uint64_t triangles = 0;
  for (const TriangleMesh& mesh : skimmed.scene.meshes)
    if (mesh.deferred) skimmed.mesh_bytes += mesh.deferred->bytes, triangles += mesh.deferred->triangles;
  constexpr std::uint64_t most_samples = 1u << 18;  // MeshMemory's
  while (triangles > most_samples) triangles /= 2;
  skimmed.sample_bytes = triangles * sizeof(DeferredMesh::Sample);
}

SkimmedScene skimmed_model(std::span<const std::uint64_t> triangles, std::uint64_t bytes, bool has_normals) {
  const std::uint64_t all =
      std::max<std::uint64_t>(std::accumulate(triangles.begin(), triangles.end(), std::uint64_t{0}), 1);
  SkimmedScene skimmed;
  skimmed.scene.materials.push_back({DiffuseMaterial{}});
  for (const std::uint64_t count : triangles) {
    const double share = static_cast<double>(count) / static_cast<double>(all);
    const auto mesh = static_cast<std::uint32_t>(skimmed.scene.meshes.size());
    skimmed.scene.meshes.push_back(
        counted_mesh(count, static_cast<std::uint64_t>(share * static_cast<double>(bytes)), has_normals));
    skimmed.scene.shapes.push_back({Id<TriangleMesh>{mesh}});
  }
  skimmed.statement_bytes = bytes;
  sum_up_meshes(skimmed);
  return skimmed;
}

}  // namespace vitrail
