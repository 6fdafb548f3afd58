// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/vertices.h"

#include <algorithm>
#include <bit>
#include <compare>
#include <limits>
#include <numeric>
#include <tuple>

namespace vitrail {

namespace {

// `order(a, b)`: a std::strong_ordering of items.
template <class Order>
std::vector<std::uint32_t> first_of_equals(std::size_t items, Order order) {
  std::vector<std::uint32_t> sorted(items), first(items);
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::ranges::sort(sorted, [&](std::uint32_t a, std::uint32_t b) {
    const std::strong_ordering found = order(a, b);
    return found != 0 ? found < 0 : a < b;
  });
  for (std::size_t i = 0; i < items; ++i) {
    const bool equal = i > 0 && order(sorted[i - 1], sorted[i]) == 0;
    first[sorted[i]] = equal ? first[sorted[i - 1]] : sorted[i];
  }
  return first;
}

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

std::strong_ordering by_position(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const auto key = [&](std::uint32_t v) {
    const Point3f p = mesh.positions[v];
    return std::tuple(bits(p.x + 0.f), bits(p.y + 0.f), bits(p.z + 0.f));
  };
  return key(a) <=> key(b);
}

std::strong_ordering by_attributes(const TriangleMesh& mesh, bool per_face, std::uint32_t a,
                                   std::uint32_t b) {
  for (const MeshAttribute& attribute : mesh.attributes) {
    if (attribute.per_face != per_face) continue;
    const auto n = static_cast<std::size_t>(attribute.channels);
    for (std::size_t i = 0; i < n; ++i)
      if (const auto order = bits(attribute.values[a * n + i]) <=> bits(attribute.values[b * n + i]);
          order != 0)
        return order;
  }
  return std::strong_ordering::equal;
}

void append_values(std::vector<float>& to, const std::vector<float>& from, std::size_t item, int channels) {
  const auto n = static_cast<std::size_t>(channels);
  for (std::size_t i = 0; i < n; ++i) to.push_back(from[item * n + i]);
}

}  // namespace

std::vector<std::uint32_t> first_at_position(const TriangleMesh& mesh) {
  return first_of_equals(mesh.positions.size(),
                         [&](std::uint32_t a, std::uint32_t b) { return by_position(mesh, a, b); });
}

std::vector<std::uint32_t> first_equal(const TriangleMesh& mesh) {
  return first_of_equals(mesh.positions.size(), [&](std::uint32_t a, std::uint32_t b) {
    auto order = by_position(mesh, a, b);
    if (order == 0 && !mesh.normals.empty()) {
      const auto key = [&](std::uint32_t v) {
        const Normal3f n = mesh.normals[v];
        return std::tuple(bits(n.x), bits(n.y), bits(n.z));
      };
      order = key(a) <=> key(b);
    }
    if (order == 0 && !mesh.uvs.empty()) {
      const auto key = [&](std::uint32_t v) { return std::tuple(bits(mesh.uvs[v].x), bits(mesh.uvs[v].y)); };
      order = key(a) <=> key(b);
    }
    return order == 0 ? by_attributes(mesh, false, a, b) : order;
  });
}

std::vector<std::uint32_t> first_equal_face(const TriangleMesh& mesh) {
  if (std::ranges::none_of(mesh.attributes, &MeshAttribute::per_face)) return {};
  return first_of_equals(mesh.triangles.size(),
                         [&](std::uint32_t a, std::uint32_t b) { return by_attributes(mesh, true, a, b); });
}

std::uint32_t append_copy(TriangleMesh& mesh, std::uint32_t vertex) {
  mesh.positions.push_back(Point3f(mesh.positions[vertex]));
  if (!mesh.normals.empty()) mesh.normals.push_back(Normal3f(mesh.normals[vertex]));
  if (!mesh.uvs.empty()) mesh.uvs.push_back(Point2f(mesh.uvs[vertex]));
  for (MeshAttribute& attribute : mesh.attributes)
    if (!attribute.per_face) {
      const std::vector<float> values(
          attribute.values.begin() + static_cast<std::ptrdiff_t>(vertex) * attribute.channels,
          attribute.values.begin() + (static_cast<std::ptrdiff_t>(vertex) + 1) * attribute.channels);
      attribute.values.insert(attribute.values.end(), values.begin(), values.end());
    }
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

TriangleMesh with_triangles(const TriangleMesh& mesh, const std::vector<Triangle>& triangles,
                            const std::vector<std::uint32_t>& sources) {
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.positions.size(), unused);
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t vertex : triangle) place[vertex] = 0;
  TriangleMesh result;
  for (const MeshAttribute& attribute : mesh.attributes)
    result.attributes.push_back({attribute.name, attribute.per_face, attribute.channels, {}});
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == unused) continue;
    place[v] = static_cast<std::uint32_t>(result.positions.size());
    result.positions.push_back(mesh.positions[v]);
    if (!mesh.normals.empty()) result.normals.push_back(mesh.normals[v]);
    if (!mesh.uvs.empty()) result.uvs.push_back(mesh.uvs[v]);
    for (std::size_t i = 0; i < mesh.attributes.size(); ++i)
      if (const MeshAttribute& from = mesh.attributes[i]; !from.per_face)
        append_values(result.attributes[i].values, from.values, v, from.channels);
  }
  result.triangles.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    result.triangles.push_back({place[a], place[b], place[c]});
    for (std::size_t i = 0; i < mesh.attributes.size(); ++i)
      if (const MeshAttribute& from = mesh.attributes[i]; from.per_face)
        append_values(result.attributes[i].values, from.values, sources[t], from.channels);
  }
  return result;
}

Vector3d scaled_normal(const TriangleMesh& mesh, const Triangle& triangle) {
  const Point3d a = cast<double>(mesh.positions[triangle[0]]);
  return cross(cast<double>(mesh.positions[triangle[1]]) - a, cast<double>(mesh.positions[triangle[2]]) - a);
}

}  // namespace vitrail
