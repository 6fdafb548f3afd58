// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/nesting_depth.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <map>

#include "scene/geometry/bounds.h"

namespace vitrail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Bounds3f*>;

Kernel::Point_3 point(Point3f p) { return {p.x, p.y, p.z}; }

bool lies_in(const Bounds3f& inner, const Bounds3f& outer) {
  for (int axis = 0; axis < 3; ++axis)
    if (inner.lower[axis] <= outer.lower[axis] || inner.upper[axis] >= outer.upper[axis]) return false;
  return true;
}

Mesh mesh_of(const std::vector<Point3f>& positions, const std::vector<Triangle>& triangles,
             const std::vector<std::uint32_t>& component) {
  Mesh mesh;
  std::map<std::uint32_t, Mesh::Vertex_index> vertices;
  const auto vertex = [&](std::uint32_t v) {
    const auto [place, is_new] = vertices.try_emplace(v);
    if (is_new) place->second = mesh.add_vertex(point(positions[v]));
    return place->second;
  };
  for (const std::uint32_t t : component) {
    const auto [a, b, c] = triangles[t];
    mesh.add_face(vertex(a), vertex(b), vertex(c));
  }
  return mesh;
}

}  // namespace

std::vector<int> nesting_depths(const std::vector<Point3f>& positions, const std::vector<Triangle>& triangles,
                                const std::vector<std::vector<std::uint32_t>>& components) {
  std::vector<Bounds3f> bounds(components.size());
  for (std::size_t i = 0; i < components.size(); ++i)
    for (const std::uint32_t t : components[i])
      for (const std::uint32_t v : triangles[t]) extend(bounds[i], positions[v]);
  std::vector<Box> boxes;
  for (const Bounds3f& b : bounds)
    boxes.emplace_back(CGAL::Bbox_3(b.lower.x, b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z), &b);
  std::vector<std::vector<std::size_t>> candidates(components.size());  // whose boxes lie in this one's
  const auto note = [&](const Box& a, const Box& b) {
    const auto i = static_cast<std::size_t>(a.handle() - bounds.data()),
               k = static_cast<std::size_t>(b.handle() - bounds.data());
    if (lies_in(bounds[i], bounds[k])) candidates[k].push_back(i);
    if (lies_in(bounds[k], bounds[i])) candidates[i].push_back(k);
  };
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), note);

  std::vector<int> depths(components.size());
  for (std::size_t outer = 0; outer < components.size(); ++outer) {
    if (candidates[outer].empty()) continue;
    const Mesh mesh = mesh_of(positions, triangles, components[outer]);
    const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(mesh);
    for (const std::size_t inner : candidates[outer]) {
      const bool inside = std::ranges::all_of(components[inner], [&](std::uint32_t t) {
        return std::ranges::all_of(triangles[t], [&](std::uint32_t v) {
          return side(point(positions[v])) == CGAL::ON_BOUNDED_SIDE;
        });
      });
      depths[inner] += inside;
    }
  }
  return depths;
}

}  // namespace vitrail
