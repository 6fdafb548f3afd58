// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj_meshes.h"

#include <algorithm>

#include "importers/obj/read/obj_smoothing.h"

namespace vitrail::obj {

namespace {

// True if the group's triangles name every index below `count`.
bool uses_all(const Group& group, std::size_t count) {
  std::vector<bool> is_used(count);
  std::size_t used = 0;
  for (const auto& triangle : group.triangles) {
    for (const std::uint32_t i : triangle) {
      used += is_used[i] ? 0 : 1;
      is_used[i] = true;
    }
  }
  return used == count;
}

// Gives an aligned group vertices: the indices that it uses, increasing. `number` has none for every index,
// and has again afterwards.
void number_vertices(Group& group, std::vector<std::uint32_t>& number) {
  GrowingArray<std::uint32_t>& used = group.vertices.positions;
  for (const auto& triangle : group.triangles) {
    for (const std::uint32_t i : triangle) {
      if (number[i] != none) continue;
      number[i] = 0;
      used.push_back(i);
    }
  }
  if (!std::is_sorted(used.begin(), used.end())) std::sort(used.begin(), used.end());
  for (std::size_t i = 0; i < used.size(); ++i) number[used[i]] = static_cast<std::uint32_t>(i);
  for (auto& triangle : group.triangles) {
    for (std::uint32_t& i : triangle) i = number[i];
  }
  for (const std::uint32_t i : used) number[i] = none;
}

template <class T>
std::vector<T> gather(const GrowingArray<T>& values, const GrowingArray<std::uint32_t>& indices) {
  std::vector<T> result;
  result.reserve(indices.size());
  prefer_huge_pages(result.data(), indices.size());
  for (const std::uint32_t i : indices) result.push_back(values[i]);
  return result;
}

MeshAttribute color_attribute(std::vector<float> values) {
  return {std::string(vertex_color), false, 3, std::move(values)};
}

// Once all groups have vertices.
void add_colors(Geometry& geometry, std::vector<TriangleMesh>& meshes) {
  if (geometry.colors.empty()) return;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    std::vector<float> values;
    for (const std::size_t p : geometry.groups[i].vertices.positions)
      values.insert(values.end(), &geometry.colors[3 * p], &geometry.colors[3 * p] + 3);
    meshes[i].attributes.push_back(color_attribute(std::move(values)));
  }
  geometry.colors = {};
}

// The only group uses the vertices as they are in the file.
TriangleMesh whole_mesh(Geometry& geometry, Group& group) {
  TriangleMesh mesh;
  if (group.has_uvs) mesh.uvs = geometry.uvs.take();
  if (group.has_normals) mesh.normals = geometry.normals.take();
  mesh.positions = geometry.positions.take();
  mesh.triangles = group.triangles.take();
  return mesh;
}

bool is_whole(const Geometry& geometry) {
  if (geometry.groups.size() != 1) return false;
  const Group& group = geometry.groups[0];
  const std::size_t count = geometry.positions.size();
  return group.is_aligned && (!group.has_uvs || geometry.uvs.size() == count) &&
         (!group.has_normals || geometry.normals.size() == count) && uses_all(group, count);
}

}  // namespace

std::vector<TriangleMesh> to_meshes(Geometry&& geometry) {
  if (!geometry.colors.empty()) geometry.colors.resize(3 * geometry.positions.size(), 1.0f);
  std::vector<TriangleMesh> meshes(geometry.groups.size());
  if (is_whole(geometry)) {
    meshes[0] = whole_mesh(geometry, geometry.groups[0]);
    if (!geometry.colors.empty()) meshes[0].attributes.push_back(color_attribute(std::move(geometry.colors)));
    return meshes;
  }
  add_smooth_normals(geometry, meshes);
  for (Group& group : geometry.groups) {
    group.vertices.next = {};
    group.vertices.first = {};
  }
  if (std::ranges::any_of(geometry.groups, &Group::is_aligned)) {
    std::vector<std::uint32_t> number(geometry.positions.size(), none);
    for (Group& group : geometry.groups) {
      if (group.is_aligned) number_vertices(group, number);
    }
  }
  // One kind of value after the other, so that what has been read of it goes before the next one is gathered.
  const auto gather_all = [&](auto& values, auto TriangleMesh::*to, auto VertexTable::*indices, auto&& has) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      Group& group = geometry.groups[i];
      if (!has(group)) continue;
      const VertexTable& vertices = group.vertices;
      meshes[i].*to = gather(values, group.is_aligned ? vertices.positions : vertices.*indices);
      if (!group.is_aligned) group.vertices.*indices = {};
    }
    values = {};
  };
  gather_all(geometry.uvs, &TriangleMesh::uvs, &VertexTable::uvs, [](const Group& g) { return g.has_uvs; });
  gather_all(geometry.normals, &TriangleMesh::normals, &VertexTable::normals,
             [](const Group& g) { return g.has_normals; });
  add_colors(geometry, meshes);
  gather_all(geometry.positions, &TriangleMesh::positions, &VertexTable::positions,
             [](const Group&) { return true; });
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    geometry.groups[i].vertices = {};
    meshes[i].triangles = geometry.groups[i].triangles.take();
  }
  return meshes;
}

}  // namespace vitrail::obj
