// SPDX-License-Identifier: Apache-2.0
// What shapes are made of, but for sets (make_csg.cpp): quadrics and meshes.
#include <fmt/format.h>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "importers/solids/primitives.h"
#include "scene/geometry/frame.h"

namespace vitrail::pov {

namespace {

// Takes +z to the vector, with its length; x and y get `radius`.
Transform along(Point3d from, Vector3d axis, double radius) {
  const double high = length(axis);
  return translate(from - Point3d{}) * transform_of(Frame(axis * (1 / high))) * scale({radius, radius, high});
}

// Two triangles for a box whose corners lie in a plane that two axes span.
std::optional<TriangleMesh> rectangle(const BoxShape& box) {
  const Vector3d size = box.corner2 - box.corner1;
  std::vector<Vector3d> sides;
  for (const Vector3d side : {Vector3d{size.x, 0, 0}, Vector3d{0, size.y, 0}, Vector3d{0, 0, size.z}})
    if (length(side) > 0) sides.push_back(side);
  if (sides.size() != 2) return std::nullopt;
  TriangleMesh mesh;
  for (const Vector3d corner : {Vector3d{}, sides[0], sides[0] + sides[1], sides[1]})
    mesh.positions.push_back(cast<float>(box.corner1 + corner));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace

SceneMaker::Piece SceneMaker::piece_with(TriangleMesh mesh, const SurfaceUvs& uvs) {
  if (!uvs.at || !reader_.has_uv_mapping) return {add_mesh(std::move(mesh)), {}, {}};
  return {add_mesh(with_uvs(mesh, uvs)), {}, {}, true, true};
}

std::vector<SceneMaker::Piece> SceneMaker::pieces_of(const Object& object) {
  if (const auto* s = std::get_if<SphereShape>(&object.shape)) {
    if (!(s->radius > 0)) return {};
    return {{quadric_mesh({QuadricKind::sphere}),
             translate(s->center - Point3d{}) * scale({s->radius, s->radius, s->radius}),
             {},
             true,
             true}};
  }
  if (const auto* s = std::get_if<DiscShape>(&object.shape)) {
    if (!(s->radius > s->hole_radius)) return {};
    return {{quadric_mesh({QuadricKind::disk, QuadricUv::pbrt, s->hole_radius / s->radius, 1}),
             along(s->center, normalize(s->normal), s->radius),
             {}}};
  }
  if (const auto* s = std::get_if<ConeShape>(&object.shape)) return round_pieces(*s);
  if (const auto* s = std::get_if<BoxShape>(&object.shape)) {
    const Vector3d size = s->corner2 - s->corner1;
    if (auto flat = rectangle(*s)) return {{add_mesh(std::move(*flat)), {}, {}}};
    if (size.x == 0 || size.y == 0 || size.z == 0) {
      reader_.notes.dropped("a box without volume", reader_.location(object.place));
      return {};
    }
    return {
        piece_with(solids::mesh_of(solids::box(s->corner1, s->corner2)), box_uvs(s->corner1, s->corner2))};
  }
  if (const auto* s = std::get_if<MeshShape>(&object.shape)) {
    std::vector<Piece> pieces;
    for (const MeshShape::Part& part : s->parts)
      if (!part.mesh->triangles.empty()) {
        TriangleMesh mesh = *part.mesh;
        if (reader_.has_uv_mapping && mesh.uvs.empty()) mesh.uvs.resize(mesh.positions.size());  // as POV-Ray
        Piece piece{add_mesh(std::move(mesh)), {}, {}, true, s->has_uvs};
        if (part.texture) piece.look = Look{part.texture, {}, nullptr};
        pieces.push_back(piece);
      }
    return pieces;
  }
  if (const auto* s = std::get_if<SolidShape>(&object.shape)) {
    if (!s->make) return {};
    try {
      TriangleMesh mesh = solids::mesh_of(s->make());
      if (mesh.triangles.empty()) return {};
      return {piece_with(std::move(mesh), s->uvs)};
    } catch (const Error& error) {
      reader_.notes.dropped(fmt::format("an object: {}", error.what()), reader_.location(object.place));
      return {};
    }
  }
  return set_pieces(object);
}

std::vector<SceneMaker::Piece> SceneMaker::round_pieces(const ConeShape& s) {
  std::vector<Piece> pieces;
  const Vector3d axis = s.cap - s.base;
  const auto disk = quadric_mesh({QuadricKind::disk, QuadricUv::pbrt, 0, 1});
  if (!s.open && s.base_radius > 0)
    pieces.push_back({disk, along(s.base, axis * (-1 / length(axis)), s.base_radius), {}});
  if (!s.open && s.cap_radius > 0)
    pieces.push_back({disk, along(s.cap, axis * (1 / length(axis)), s.cap_radius), {}});
  if (s.base_radius == s.cap_radius) {
    if (s.base_radius > 0)
      pieces.push_back({quadric_mesh({QuadricKind::cylinder}), along(s.base, axis, s.base_radius), {}});
  } else if (s.cap_radius == 0) {
    pieces.push_back({quadric_mesh({QuadricKind::cone}), along(s.base, axis, s.base_radius), {}});
  } else if (s.base_radius == 0) {
    pieces.push_back({quadric_mesh({QuadricKind::cone}), along(s.cap, -axis, s.cap_radius), {}});
  } else {
    const solids::Solid side = solids::cone({s.base, s.base_radius, s.cap, s.cap_radius, true});
    pieces.push_back({add_mesh(solids::mesh_of(side)), {}, {}});
  }
  return pieces;
}

}  // namespace vitrail::pov
