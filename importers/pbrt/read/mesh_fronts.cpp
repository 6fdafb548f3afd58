// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/mesh_fronts.h"

#include <algorithm>
#include <array>

#include "scene/shapes/mesh_uv.h"

namespace vitrail::pbrt {

namespace {

Vector3d corner_normal_sum(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  Vector3d sum;
  for (const std::uint32_t corner : triangle)
    sum = sum + normalize(to_vector(cast<double>(mesh.normals[corner])));
  return sum;
}

Vector3d winding_normal(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Point3d a = cast<double>(mesh.positions[triangle[0]]), b = cast<double>(mesh.positions[triangle[1]]),
                c = cast<double>(mesh.positions[triangle[2]]);
  return cross(b - a, c - a);
}

// Lengths of normals do not matter where all three agree, as they do nearly everywhere.
bool faces_away(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vector3d winding = winding_normal(mesh, triangle);
  const bool all_agree = std::ranges::all_of(triangle, [&](std::uint32_t corner) {
    return dot(winding, to_vector(cast<double>(mesh.normals[corner]))) > 0;
  });
  return !all_agree && dot(winding, corner_normal_sum(mesh, triangle)) < 0;
}

}  // namespace

bool orient_by_normals(TriangleMesh& mesh, bool uvs_show) {
  if (mesh.normals.empty()) return false;
  const auto is_away = [&](const auto& triangle) { return faces_away(mesh, triangle); };
  const auto away = static_cast<std::size_t>(std::ranges::count_if(mesh.triangles, is_away));
  if (away == 0) return false;
  const bool differs = mesh.uvs.empty();
  if (away == mesh.triangles.size()) {
    turn_round(mesh, uvs_show);
    return differs;
  }
  if (uvs_show) mesh = with_uvs(std::move(mesh));
  for (auto& triangle : mesh.triangles)
    if (is_away(triangle)) std::swap(triangle[1], triangle[2]);
  return differs;
}

bool fronts_follow_normals(const TriangleMesh& mesh) {
  return mesh.normals.empty() ||
         std::none_of(mesh.triangles.begin(), mesh.triangles.end(),
                      [&](const auto& triangle) { return faces_away(mesh, triangle); });
}

TriangleMesh with_normals_in_front(TriangleMesh mesh) {
  std::vector<char> turned(mesh.positions.size(), 0);
  for (const auto& triangle : mesh.triangles)
    if (faces_away(mesh, triangle))
      for (const std::uint32_t corner : triangle) turned[corner] = 1;
  for (std::size_t i = 0; i < turned.size(); ++i)
    if (turned[i]) mesh.normals[i] = -mesh.normals[i];
  if (!fronts_follow_normals(mesh)) mesh.normals.clear();
  return mesh;
}

}  // namespace vitrail::pbrt
