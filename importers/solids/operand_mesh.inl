// SPDX-License-Identifier: Apache-2.0
// Solids as CGAL's meshes, whose faces know the triangles that they come from. It is included behind CGAL's
// headers for corefinement, polygon soups and Surface_mesh: no header here includes CGAL, so that what
// contains it can be told from the sources.
#pragma once

#include <map>
#include <optional>
#include <span>

#include "importers/solids/solid.h"

namespace vitrail::solids {

// Where a face came from: `operands · triangle + operand`. 0xffffffff: from nowhere.
inline constexpr std::uint32_t nowhere = 0xffffffff;
inline constexpr const char* origins = "f:origin";

template <class Mesh>
using Origins = typename Mesh::template Property_map<typename Mesh::Face_index, std::uint32_t>;

template <class Mesh>
struct OperandMesh {
  Mesh mesh;
  Origins<Mesh> from;
};

// Returns operand number `operand` of so many. Nothing where the triangles are no manifold even if vertices
// are doubled.
template <class Mesh>
std::optional<OperandMesh<Mesh>> operand_mesh(const Solid& solid, std::uint32_t operand,
                                              std::uint32_t operands) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  std::vector<typename Mesh::Point> points;
  points.reserve(solid.positions.size());
  for (const Point3d& p : solid.positions) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> faces;
  faces.reserve(solid.triangles.size());
  for (const auto& [a, b, c] : solid.triangles) faces.push_back({a, b, c});
  if (!pmp::is_polygon_soup_a_polygon_mesh(faces)) {
    pmp::orient_polygon_soup(points, faces);
    if (!pmp::is_polygon_soup_a_polygon_mesh(faces)) return std::nullopt;
  }
  OperandMesh<Mesh> made;
  pmp::polygon_soup_to_polygon_mesh(points, faces, made.mesh);
  made.from =
      made.mesh.template add_property_map<typename Mesh::Face_index, std::uint32_t>(origins, nowhere).first;
  std::uint32_t triangle = 0;
  for (const auto f : made.mesh.faces()) made.from[f] = operands * triangle++ + operand;
  return made;
}

// Passes origins on to the parts and copies of faces.
template <class Mesh>
struct PassOrigins : CGAL::Polygon_mesh_processing::Corefinement::Default_visitor<Mesh> {
  using Face = typename Mesh::Face_index;
  std::map<const Mesh*, Origins<Mesh>>* of;
  std::uint32_t split = nowhere;

  explicit PassOrigins(std::map<const Mesh*, Origins<Mesh>>& known) : of(&known) {}
  Origins<Mesh>& origins_of(Mesh& mesh) {
    const auto known = of->find(&mesh);
    if (known != of->end()) return known->second;
    return of->emplace(&mesh, mesh.template add_property_map<Face, std::uint32_t>(origins, nowhere).first)
        .first->second;
  }
  void before_subface_creations(Face face, Mesh& mesh) { split = origins_of(mesh)[face]; }
  void after_subface_created(Face face, Mesh& mesh) { origins_of(mesh)[face] = split; }
  void after_face_copy(Face from, Mesh& source, Face to, Mesh& target) {
    const std::uint32_t origin = origins_of(source)[from];
    origins_of(target)[to] = origin;
  }
};

// Triangles have the surfaces and normals of the operands that they come from; `turns_others`: those of all
// but the first look the other way.
template <class Mesh>
Solid solid_of(const Mesh& mesh, const Origins<Mesh>& from, std::span<const Solid* const> operands,
               bool turns_others, bool closed) {
  Solid solid;
  solid.closed = closed;
  std::vector<std::uint32_t> number(mesh.number_of_vertices() + mesh.number_of_removed_vertices());
  for (const auto v : mesh.vertices()) {
    number[v] = static_cast<std::uint32_t>(solid.positions.size());
    const auto& p = mesh.point(v);
    solid.positions.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  }
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> t{};
    std::size_t i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[i++] = number[v];
    const std::size_t which = from[f] % operands.size(), triangle = from[f] / operands.size();
    const Solid& operand = *operands[which];
    if (triangle >= operand.triangles.size()) continue;  // cannot be: CGAL reports each face
    std::array<Normal3f, 3> normals;
    for (i = 0; i < 3; ++i) {
      normals[i] = normal_at(operand, triangle, solid.positions[t[i]]);
      if (which > 0 && turns_others) normals[i] = {-normals[i].x, -normals[i].y, -normals[i].z};
    }
    solid.triangles.push_back(t);
    solid.normals.push_back(normals);
    solid.surfaces.push_back(operand.surfaces[triangle]);
  }
  return solid;
}

}  // namespace vitrail::solids
