// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/solid.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>
#include <unordered_set>

#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

// A vertex of a mesh: the bits of its place and normal.
struct Corner {
  std::uint32_t position;
  Normal3f normal;
  bool operator==(const Corner&) const = default;
};

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    std::array<std::uint32_t, 3> bits;
    const std::array normal{c.normal.x + 0.0f, c.normal.y + 0.0f, c.normal.z + 0.0f};  // −0 = 0
    std::memcpy(bits.data(), normal.data(), sizeof bits);
    std::size_t hash = c.position;
    for (const std::uint32_t b : bits) hash = (hash ^ b) * 0x9e3779b97f4a7c15ull, hash ^= hash >> 29;
    return hash;
  }
};

template <class IsWanted>
TriangleMesh mesh_where(const Solid& solid, IsWanted&& is_wanted) {
  TriangleMesh mesh;
  std::unordered_map<Corner, std::uint32_t, CornerHash> vertices;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    if (!is_wanted(solid.surfaces[t])) continue;
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner corner{solid.triangles[t][i], solid.normals[t][i]};
      const auto [known, is_new] =
          vertices.try_emplace(corner, static_cast<std::uint32_t>(mesh.positions.size()));
      if (is_new) {
        const Point3f p = cast<float>(solid.positions[corner.position]);
        if (!is_finite(p)) throw Error("a solid is not finite in single precision");
        mesh.positions.push_back(p);
        mesh.normals.push_back(corner.normal);
      }
      triangle[i] = known->second;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace

TriangleMesh mesh_of(const Solid& solid) {
  return mesh_where(solid, [](std::uint32_t surface) { return surface != unseen; });
}

TriangleMesh mesh_of(const Solid& solid, std::uint32_t wanted) {
  return mesh_where(solid, [wanted](std::uint32_t surface) { return surface == wanted; });
}

std::vector<std::uint32_t> surfaces_of(const Solid& solid) {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t s : solid.surfaces)
    if (s != unseen && (found.empty() || found.back() != s)) found.push_back(s);
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void set_surface(Solid& solid, std::uint32_t surface) {
  for (std::uint32_t& s : solid.surfaces)
    if (s != unseen) s = surface;
}

Solid transformed(Solid solid, const Transform& to) {
  if (!is_invertible(to)) throw Error("the transform of a solid has no inverse");
  for (Point3d& p : solid.positions) p = transform_point(to, p);
  for (auto& triangle : solid.normals)
    for (Normal3f& n : triangle)
      n = cast<float>(to_normal(normalize(to_vector(transform_normal(to, cast<double>(n))))));
  if (swaps_handedness(to))
    for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
      std::swap(solid.triangles[t][1], solid.triangles[t][2]);
      std::swap(solid.normals[t][1], solid.normals[t][2]);
    }
  return solid;
}

Solid inverted(Solid solid) {
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    std::swap(solid.triangles[t][1], solid.triangles[t][2]);
    std::swap(solid.normals[t][1], solid.normals[t][2]);
    for (Normal3f& n : solid.normals[t]) n = {-n.x, -n.y, -n.z};
  }
  return solid;
}

void append(Solid& solid, const Solid& other) {
  const auto first = static_cast<std::uint32_t>(solid.positions.size());
  solid.closed = solid.closed && other.closed;
  solid.positions.insert(solid.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& [a, b, c] : other.triangles) solid.triangles.push_back({a + first, b + first, c + first});
  solid.normals.insert(solid.normals.end(), other.normals.begin(), other.normals.end());
  solid.surfaces.insert(solid.surfaces.end(), other.surfaces.begin(), other.surfaces.end());
}

Bounds3d bounds_of(const Solid& solid) {
  Bounds3d bounds;
  for (const Point3d& p : solid.positions) extend(bounds, p);
  return bounds;
}

bool boxes_meet(const Bounds3d& a, const Bounds3d& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]) return false;
  return !a.empty() && !b.empty();
}

// Barycentric on the greatest projection.
Normal3f normal_at(const Solid& solid, std::size_t triangle, Point3d p) {
  const auto& corners = solid.triangles[triangle];
  const auto& [na, nb, nc] = solid.normals[triangle];
  for (std::size_t i = 0; i < 3; ++i)
    if (solid.positions[corners[i]] == p) return solid.normals[triangle][i];
  const Point3d origin = solid.positions[corners[0]];
  const Vector3d e1 = solid.positions[corners[1]] - origin, e2 = solid.positions[corners[2]] - origin,
                 d = p - origin, n = cross(e1, e2);
  const double area = dot(n, n);
  double v = area > 0 ? dot(cross(d, e2), n) / area : 0, w = area > 0 ? dot(cross(e1, d), n) / area : 0;
  v = std::clamp(v, 0.0, 1.0);
  w = std::clamp(w, 0.0, 1.0 - v);
  if (v == 0 && w == 0) return na;
  const auto vector = [](const Normal3f& of) { return to_vector(cast<double>(of)); };
  return cast<float>(to_normal(normalize(vector(na) * (1 - v - w) + vector(nb) * v + vector(nc) * w)));
}

double volume(const Solid& solid) {
  const Point3d origin = solid.positions.empty() ? Point3d{} : solid.positions.front();
  double sum = 0;
  for (const auto& [a, b, c] : solid.triangles)
    sum +=
        dot(solid.positions[a] - origin, cross(solid.positions[b] - origin, solid.positions[c] - origin)) / 6;
  return sum;
}

bool is_watertight(const Solid& solid) {
  std::unordered_map<std::uint64_t, int> edges;
  edges.reserve(solid.triangles.size() * 3);
  const auto key = [](std::uint64_t a, std::uint64_t b) { return a << 32 | b; };
  for (const auto& t : solid.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (t[i] == t[(i + 1) % 3] || ++edges[key(t[i], t[(i + 1) % 3])] > 1) return false;
  return std::ranges::all_of(edges, [&](const auto& edge) {
    return edges.contains(key(edge.first & 0xffffffff, edge.first >> 32));
  });
}

}  // namespace vitrail::solids
