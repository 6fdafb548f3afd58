// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/repair.h"

#include <algorithm>
#include <numeric>

#include "partitioner/meshes/exact.h"
#include "partitioner/meshes/vertices.h"

namespace vitrail {

namespace {

// Equal for triangles with the same corners: turned to its least corner and, unless the two sides are told
// apart, with the other two sorted.
Triangle key(Triangle t, bool with_side) {
  std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  if (!with_side && t[1] > t[2]) std::swap(t[1], t[2]);
  return t;
}

// In place: one number a kept triangle, in order.
void drop_duplicates(std::vector<std::uint32_t>& kept, const std::vector<Triangle>& keys) {
  std::vector<std::uint32_t> sorted = kept;
  std::ranges::sort(sorted, [&](std::uint32_t a, std::uint32_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  });
  const auto is_same = [&](std::uint32_t a, std::uint32_t b) { return keys[a] == keys[b]; };
  sorted.erase(std::unique(sorted.begin(), sorted.end(), is_same), sorted.end());
  std::ranges::sort(sorted);
  kept = std::move(sorted);
}

}  // namespace

RepairedMesh repair(const TriangleMesh& mesh, bool keep_opposite) {
  RepairedMesh result;
  const std::vector<std::uint32_t> point = first_at_position(mesh), vertex = first_equal(mesh);
  std::vector<std::uint32_t> kept;
  std::vector<Triangle> keys(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    keys[i] = key({point[a], point[b], point[c]}, keep_opposite);
    if (!is_degenerate(mesh.positions[a], mesh.positions[b], mesh.positions[c])) kept.push_back(i);
  }
  result.degenerate_triangles = mesh.triangles.size() - kept.size();
  const std::size_t proper = kept.size();
  drop_duplicates(kept, keys);
  result.duplicate_triangles = proper - kept.size();

  std::vector<Triangle> triangles;
  triangles.reserve(kept.size());
  for (const std::uint32_t i : kept) {
    const auto [a, b, c] = mesh.triangles[i];
    triangles.push_back({vertex[a], vertex[b], vertex[c]});
  }
  result.mesh = with_triangles(mesh, triangles, kept);
  for (std::uint32_t v = 0; v < vertex.size(); ++v) result.merged_vertices += vertex[v] != v;
  result.unused_vertices = mesh.positions.size() - result.merged_vertices - result.mesh.positions.size();
  return result;
}

}  // namespace vitrail
