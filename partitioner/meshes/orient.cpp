// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/orient.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include <algorithm>
#include <map>

#include "partitioner/meshes/exact.h"
#include "partitioner/meshes/nesting_depth.h"
#include "partitioner/meshes/vertices.h"

namespace vitrail {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Polygon = std::array<std::size_t, 3>;

struct Turns : pmp::Default_orientation_visitor {
  std::vector<bool>* turned = nullptr;
  void polygon_orientation_reversed(std::size_t i) { (*turned)[i] = !(*turned)[i]; }
};

struct Components {
  std::vector<Point3f> positions;               // with a copy of a point for each sheet that meets there
  std::vector<Triangle> triangles;              // turned consistently
  std::vector<std::uint32_t> sources;           // of each triangle in the mesh
  std::vector<bool> turned;                     // against the mesh
  std::vector<std::vector<std::uint32_t>> all;  // numbers of triangles
  std::vector<bool> closed;
};

std::vector<bool> closed_components(const std::vector<Triangle>& triangles,
                                    const std::vector<std::uint32_t>& component, std::size_t components) {
  struct Edge {
    std::uint32_t low, high, component;
  };
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[i][k], triangles[i][(k + 1) % 3]);
      edges.push_back({low, high, component[i]});
    }
  std::ranges::sort(edges, {}, [](const Edge& e) { return std::pair(e.low, e.high); });
  std::vector<bool> closed(components, true);
  const auto same = [&](std::size_t i, std::size_t k) {
    return edges[i].low == edges[k].low && edges[i].high == edges[k].high;
  };
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && same(i, end)) ++end;
    if (end - i != 2) closed[edges[i].component] = false;
  }
  return closed;
}

void find_components(Components& c) {
  std::vector<std::uint32_t> parent(c.positions.size());
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = v;
  const auto find = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : c.triangles)
    for (const std::uint32_t v : {t[1], t[2]}) parent[find(v)] = find(t[0]);
  std::map<std::uint32_t, std::uint32_t> numbers;
  std::vector<std::uint32_t> component;
  for (std::uint32_t i = 0; i < c.triangles.size(); ++i) {
    const auto number =
        numbers.try_emplace(find(c.triangles[i][0]), static_cast<std::uint32_t>(numbers.size()))
            .first->second;
    c.all.resize(numbers.size());
    c.all[number].push_back(i);
    component.push_back(number);
  }
  c.closed = closed_components(c.triangles, component, c.all.size());
}

Components consistent_components(const TriangleMesh& mesh) {
  Components c;
  const std::vector<std::uint32_t> point = first_at_position(mesh);
  std::vector<std::uint32_t> points(mesh.positions.size());  // of the soup; CGAL appends copies
  for (std::uint32_t v = 0; v < points.size(); ++v) points[v] = v;
  std::vector<Polygon> polygons;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, d] = mesh.triangles[i];
    if (point[a] == point[b] || point[b] == point[d] || point[d] == point[a]) continue;
    c.sources.push_back(i);
    polygons.push_back({point[a], point[b], point[d]});
  }
  c.turned.resize(polygons.size());
  Turns turns;
  turns.turned = &c.turned;
  pmp::orient_polygon_soup(points, polygons, CGAL::parameters::visitor(turns));
  for (const std::uint32_t v : points) c.positions.push_back(mesh.positions[v]);
  for (const Polygon& p : polygons)
    c.triangles.push_back({static_cast<std::uint32_t>(p[0]), static_cast<std::uint32_t>(p[1]),
                           static_cast<std::uint32_t>(p[2])});
  find_components(c);
  return c;
}

// Whether most of the area runs the other way in the mesh.
bool mostly_turned(const TriangleMesh& mesh, const Components& c,
                   const std::vector<std::uint32_t>& component) {
  double balance = 0;
  for (const std::uint32_t t : component)
    balance += (c.turned[t] ? 1 : -1) * length(scaled_normal(mesh, mesh.triangles[c.sources[t]]));
  return balance > 0;
}

void turn_normals(TriangleMesh& mesh) {
  if (mesh.normals.empty()) return;
  constexpr std::uint32_t none = ~0u;
  const auto originals = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<std::uint32_t> copy(originals, none);  // of a vertex, that faces the other way
  std::vector<signed char> facing(originals);        // 0: not yet known
  for (Triangle& triangle : mesh.triangles) {
    const Vector3d front = scaled_normal(mesh, triangle);
    double side = 0;  // of the normals as they were
    for (const std::uint32_t v : triangle)
      side += (facing[v] < 0 ? -1 : 1) * dot(to_vector(cast<double>(mesh.normals[v])), front);
    const signed char wanted = side < 0 ? -1 : 1;
    for (std::uint32_t& v : triangle) {
      if (facing[v] == 0) {
        facing[v] = wanted;
        if (wanted < 0) mesh.normals[v] = -mesh.normals[v];
      } else if (facing[v] != wanted) {
        if (copy[v] == none) {
          copy[v] = append_copy(mesh, v);
          mesh.normals.back() = -mesh.normals[v];
        }
        v = copy[v];
      }
    }
  }
}

}  // namespace

OrientedMesh orient(const TriangleMesh& mesh, Facing sides) {
  Components c = consistent_components(mesh);
  std::vector<std::vector<std::uint32_t>> closed;
  for (std::size_t i = 0; i < c.all.size(); ++i)
    if (c.closed[i]) closed.push_back(c.all[i]);
  OrientedMesh result{mesh, 0, c.all.size(), closed.size(), 0};
  const std::vector<int> depths = sides == Facing::consistent
                                      ? std::vector<int>(closed.size())
                                      : nesting_depths(c.positions, c.triangles, closed);
  TriangleMesh consistent;  // what `volume_sign` asks of a mesh
  consistent.positions = c.positions;
  consistent.triangles = c.triangles;
  for (std::size_t i = 0, nth_closed = 0; i < c.all.size(); ++i) {
    const int depth = c.closed[i] ? depths[nth_closed++] : 0;
    const int sign = c.closed[i] && sides != Facing::consistent ? volume_sign(consistent, c.all[i]) : 0;
    const bool outer = depth % 2 == 0;
    const bool turn =
        sign == 0 ? mostly_turned(mesh, c, c.all[i]) : (sign > 0) != ((sides == Facing::outward) == outer);
    result.inner_components += !outer;
    for (const std::uint32_t t : c.all[i])
      if (c.turned[t] != turn) {
        std::swap(result.mesh.triangles[c.sources[t]][1], result.mesh.triangles[c.sources[t]][2]);
        ++result.turned_triangles;
      }
  }
  turn_normals(result.mesh);
  return result;
}

}  // namespace vitrail
