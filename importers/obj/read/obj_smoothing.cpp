// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj_smoothing.h"

#include <unordered_map>

#include "importers/shapes/vertex_normals.h"

namespace vitrail::obj {

namespace {

using Sums = std::unordered_map<std::uint64_t, Vector3d>;  // by position and smoothing group

std::uint64_t key_of(const Group& group, std::uint32_t vertex) {
  return std::uint64_t{group.vertices.normals[vertex]} << 32 | group.vertices.positions[vertex];
}

void add(const Geometry& geometry, const Group& group, Sums& sums) {
  const auto position = [&](std::uint32_t vertex) {
    return cast<double>(geometry.positions[group.vertices.positions[vertex]]);
  };
  for (const auto& t : group.triangles) {
    const auto normals = angle_weighted_normals({position(t[0]), position(t[1]), position(t[2])});
    for (std::size_t i = 0; i < 3; ++i) {
      Vector3d& sum = sums[key_of(group, t[i])];
      sum = sum + normals[i];
    }
  }
}

}  // namespace

void add_smooth_normals(const Geometry& geometry, std::vector<TriangleMesh>& meshes) {
  Sums sums;
  for (const Group& group : geometry.groups)
    if (group.is_smooth) add(geometry, group, sums);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Group& group = geometry.groups[i];
    if (!group.is_smooth) continue;
    for (std::uint32_t v = 0; v < group.vertices.positions.size(); ++v)
      meshes[i].normals.push_back(unit_normal(sums.at(key_of(group, v))));
  }
}

}  // namespace vitrail::obj
