// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cli/mesh_options.h"
#include "importers/shapes/shapes.h"
#include "partitioner/meshes/edit_meshes.h"

namespace vitrail {

Diagnostics apply_mesh_options(const MeshOptions& o, Scene& scene, const MeshResources& resources) {
  if (!o.any()) return {};
  const auto loop = [](const TriangleMesh& cage, int levels, std::vector<std::array<Point2d, 3>>& corners) {
    return loop_subdivide(cage, levels, &corners);
  };
  EditedMeshes edited = edit_meshes(scene, {o.repair, o.orient, o.subdivide, o.decimate, loop}, resources);
  fmt::print(stderr, "meshes: {} triangles became {}\n", edited.triangles_before, edited.triangles_after);
  return std::move(edited.notes);
}

}  // namespace vitrail
