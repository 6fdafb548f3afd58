// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj_group.h"

#include "scene/system/diagnostics.h"

namespace vitrail::obj {

namespace {

bool is_aligned(const Group& group, const Corner& corner) {
  return !group.is_smooth && (!group.has_uvs || corner.uv == corner.position) &&
         (!group.has_normals || corner.normal == corner.position);
}

// Of corners and of the table of vertices.
bool keeps_normals(const Group& group) { return group.has_normals || group.is_smooth; }

// Files name near positions in turn, mostly at a constant distance from the other indices: the places are
// near too.
std::size_t place(const Group& group, const Corner& corner) {
  const auto spread = [&](std::uint32_t index) {
    return ((std::uint64_t{index} - corner.position) * 0x9e3779b97f4a7c15u) >> 32;
  };
  std::size_t sum = corner.position;
  if (group.has_uvs) sum += spread(corner.uv);
  if (keeps_normals(group)) sum += 3 * spread(corner.normal);
  return sum & (group.vertices.first.size() - 1);
}

Corner corner_of(const Group& group, std::size_t vertex) {
  const VertexTable& table = group.vertices;
  return {table.positions[vertex], group.has_uvs ? table.uvs[vertex] : none,
          keeps_normals(group) ? table.normals[vertex] : none};
}

void grow(Group& group) {
  VertexTable& table = group.vertices;
  constexpr std::size_t least = 256;
  table.first = {};
  table.first.resize(std::max(least, 2 * table.positions.size()), none);
  // Backwards, so that of one place the vertex that came first is found first.
  for (std::size_t i = table.positions.size(); i-- > 0;) {
    std::uint32_t& first = table.first[place(group, corner_of(group, i))];
    table.next[i] = first;
    first = static_cast<std::uint32_t>(i);
  }
}

std::uint32_t vertex(Group& group, Corner corner) {
  VertexTable& table = group.vertices;
  if (!group.has_uvs) corner.uv = none;
  if (!keeps_normals(group)) corner.normal = none;
  if (table.positions.size() >= 2 * table.first.size()) grow(group);
  std::uint32_t* link = &table.first[place(group, corner)];
  for (; *link != none; link = &table.next[*link]) {
    if (corner_of(group, *link) == corner) return *link;
  }
  if (table.positions.size() == none) throw Error("more vertices than 32 bits count; split the mesh");
  const auto index = static_cast<std::uint32_t>(table.positions.size());
  *link = index;
  table.positions.push_back(corner.position);
  if (group.has_uvs) table.uvs.push_back(corner.uv);
  if (keeps_normals(group)) table.normals.push_back(corner.normal);
  table.next.push_back(none);
  return index;
}

void begin_table(Group& group) {
  group.is_aligned = false;
  for (auto& triangle : group.triangles) {
    for (std::uint32_t& i : triangle) i = vertex(group, {i, i, i});
  }
}

}  // namespace

void add_triangle(Group& group, const Corner& a, const Corner& b, const Corner& c) {
  if (group.is_aligned) {
    if (is_aligned(group, a) && is_aligned(group, b) && is_aligned(group, c)) {
      return group.triangles.push_back({a.position, b.position, c.position});
    }
    begin_table(group);
  }
  group.triangles.push_back({vertex(group, a), vertex(group, b), vertex(group, c)});
}

}  // namespace vitrail::obj
