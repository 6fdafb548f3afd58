// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "importers/bytes/growing_array.h"

namespace vitrail::obj {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

struct Corner {
  std::uint32_t position = none, uv = none, normal = none;
  bool operator==(const Corner&) const = default;
};

// Corners that agree in all indices become one vertex, numbered as they come. Each index has an array of its
// own, which can be freed when its values have been gathered.
struct VertexTable {
  GrowingArray<std::uint32_t> positions, uvs, normals;  // the latter two where the group has them
  GrowingArray<std::uint32_t> next;                     // of the vertices with the same hash
  std::vector<std::uint32_t> first;                     // of each hash; as many as a power of two
};

// It has the triangles of one object and material that have texture coordinates and normals, or have not.
struct Group {
  std::size_t object = 0, material = 0;
  bool has_uvs = false, has_normals = false;
  // Normals are made, of all triangles that share a vertex and a smoothing group: Corner::normal is the
  // number of that group.
  bool is_smooth = false;
  // While every corner has one and the same index for all that it has, no table of vertices is needed:
  // triangles hold that index. Otherwise they hold vertices.
  bool is_aligned = true;
  GrowingArray<std::array<std::uint32_t, 3>> triangles;
  VertexTable vertices;
};

// Ignores indices that the group's corners do not have.
void add_triangle(Group& group, const Corner& a, const Corner& b, const Corner& c);

}  // namespace vitrail::obj
