// SPDX-License-Identifier: Apache-2.0
// difference, intersection, merge and clipped_by, by importers/solids.
#include <fmt/format.h>

#include <algorithm>

#include "importers/povray/read/extents.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "importers/solids/primitives.h"

namespace vitrail::pov {

namespace {

// Triangles that share vertices by place.
solids::Solid solid_of(const MeshShape& shape) {
  solids::Solid solid;
  std::map<std::array<float, 3>, std::uint32_t> places;
  for (const MeshShape::Part& part : shape.parts) {
    const TriangleMesh& mesh = *part.mesh;
    for (const auto& t : mesh.triangles) {
      std::array<std::uint32_t, 3> corners;
      std::array<Normal3f, 3> normals;
      for (std::size_t i = 0; i < 3; ++i) {
        const Point3f p = mesh.positions[t[i]];
        const auto [at, added] =
            places.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(solid.positions.size()));
        if (added) solid.positions.push_back(cast<double>(p));
        corners[i] = at->second;
        if (!mesh.normals.empty()) normals[i] = mesh.normals[t[i]];
      }
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[0] == corners[2]) continue;
      const Point3d a = solid.positions[corners[0]], b = solid.positions[corners[1]],
                    c = solid.positions[corners[2]];
      if (mesh.normals.empty()) normals.fill(to_normal(cast<float>(normalize(cross(b - a, c - a)))));
      solid.triangles.push_back(corners);
      solid.normals.push_back(normals);
      solid.surfaces.push_back(0);
    }
  }
  solid.closed = solids::is_watertight(solid);
  if (solid.closed && solids::volume(solid) < 0) solid = solids::inverted(std::move(solid));
  return solid;
}

// Whether its shape alone goes on for ever.
bool is_endless(const Shared<Object>& object) {
  const auto* const solid = std::get_if<SolidShape>(&object->shape);
  return std::holds_alternative<PlaneShape>(object->shape) || (solid && solid->unbounded);
}

SurfaceUvs uvs_of(const Object& object) {
  if (const auto* s = std::get_if<SphereShape>(&object.shape)) return sphere_uvs(s->center);
  if (const auto* s = std::get_if<BoxShape>(&object.shape)) return box_uvs(s->corner1, s->corner2);
  const auto* const solid = std::get_if<SolidShape>(&object.shape);
  return solid ? solid->uvs : SurfaceUvs{};
}

}  // namespace

std::optional<solids::Csg> SceneMaker::shape_csg(const Object& object, std::uint32_t surface) {
  using namespace solids;
  if (const auto* s = std::get_if<SphereShape>(&object.shape))
    return solid(sphere(s->center, s->radius), surface);
  if (const auto* s = std::get_if<BoxShape>(&object.shape))
    return solid(box(s->corner1, s->corner2), surface);
  if (const auto* s = std::get_if<PlaneShape>(&object.shape))
    return half_space({s->normal, s->distance}, surface);
  if (const auto* s = std::get_if<ConeShape>(&object.shape))
    return solid(cone({s->base, s->base_radius, s->cap, s->cap_radius, s->open}), surface);
  if (const auto* s = std::get_if<DiscShape>(&object.shape))
    return solid(disc(s->center, s->normal, s->radius, s->hole_radius), surface);
  if (const auto* s = std::get_if<MeshShape>(&object.shape)) return solid(solid_of(*s), surface);
  if (const auto* s = std::get_if<SolidShape>(&object.shape)) {
    if (s->unbounded) return unbounded(*s->unbounded, surface);
    if (s->make) return solid(s->make(), surface);
  }
  return std::nullopt;
}

std::optional<solids::Csg> SceneMaker::csg_of(const Object& object, const Transform& parent_to_set,
                                              const Look& look, std::vector<Look>& looks) {
  using namespace solids;
  Look own = look;
  if (object.texture) own.texture = object.texture, own.to_world = parent_to_set;
  if (object.interior) own.interior = object.interior;
  const Transform to_set = parent_to_set * object.to_parent;
  std::optional<Csg> result;
  if (const auto* group = std::get_if<GroupShape>(&object.shape)) {
    std::vector<Csg> operands;
    for (const auto& child : object.children) {
      if (std::holds_alternative<LightShape>(child->shape)) {
        reader_.notes.dropped("a light in a difference, intersection or merge",
                              reader_.location(child->place));
        continue;
      }
      if (auto operand = csg_of(*child, to_set, own, looks)) operands.push_back(std::move(*operand));
    }
    if (operands.empty()) return std::nullopt;
    switch (group->kind) {
      case Word::merge_:
        result = merge(std::move(operands));
        break;
      case Word::intersection_:
        result = intersection(std::move(operands));
        if (std::ranges::all_of(object.children, is_endless))
          result->bounds = moved_box(own_box(object), to_set);
        break;
      case Word::difference_:
        result = difference(std::move(operands));
        break;
      default:
        result = unite(std::move(operands));
    }
  } else {
    own.uvs = moved(uvs_of(object), to_set);
    looks.push_back(own);
    try {
      result = shape_csg(object, static_cast<std::uint32_t>(looks.size() - 1));
    } catch (const Error& error) {
      reader_.notes.dropped(fmt::format("an object: {}", error.what()), reader_.location(object.place));
    }
    if (!result) return std::nullopt;
    result = transformed(std::move(*result), to_set);
  }
  if (!object.clipped_by.empty()) {
    std::vector<Csg> by;
    std::vector<Look> unseen_looks;
    for (const auto& clip : object.clipped_by)
      if (auto csg = csg_of(*clip, parent_to_set, {}, unseen_looks)) by.push_back(std::move(*csg));
    if (!by.empty()) {
      result = cut_surfaces(std::move(*result), std::move(by));
      Bounds3d box = region_of(*object.clipped_by.front());
      for (const auto& clip : object.clipped_by) box = common(box, region_of(*clip));
      if (!box.empty()) result->bounds = moved_box(box, parent_to_set);
    }
  }
  if (object.inverse) result = complement(std::move(*result));
  return result;
}

std::vector<SceneMaker::Piece> SceneMaker::evaluated(const solids::Csg& csg, const std::vector<Look>& looks,
                                                     const Object& object) {
  const solids::CsgResult result = solids::evaluate(csg, {.reach = reach_});
  const SourceLocation place = reader_.location(object.place);
  for (const std::string& reason : result.refused)
    reader_.notes.approximated(fmt::format("a set of objects: an operation is left out, as {}", reason),
                               place);
  if (result.perturbation > 0)
    reader_.notes.approximated(
        fmt::format("a set of objects: a part is moved by {:.1g} of its size, as surfaces touch",
                    result.perturbation),
        place);
  std::vector<Piece> pieces;
  for (const std::uint32_t surface : solids::surfaces_of(result.solid)) {
    TriangleMesh mesh = solids::mesh_of(result.solid, surface);
    if (mesh.triangles.empty()) continue;
    Piece piece = piece_with(std::move(mesh), surface < looks.size() ? looks[surface].uvs : SurfaceUvs{});
    if (surface < looks.size() && (looks[surface].texture || looks[surface].interior))
      piece.look = looks[surface];
    pieces.push_back(piece);
  }
  return pieces;
}

// Of the shape alone: without the texture, the transformation and the inversion of the object itself.
std::vector<SceneMaker::Piece> SceneMaker::set_pieces(const Object& object) {
  Object inner = object;
  inner.to_parent = {};
  inner.texture = nullptr, inner.interior = nullptr, inner.inverse = false;
  inner.clipped_by.clear();
  std::vector<Look> looks;
  const auto csg = csg_of(inner, {}, {}, looks);
  return csg ? evaluated(*csg, looks, object) : std::vector<Piece>{};
}

// In the space of the object's parent.
std::vector<SceneMaker::Piece> SceneMaker::clipped_pieces(const Object& object) {
  Object inner = object;
  inner.texture = nullptr, inner.interior = nullptr, inner.inverse = false;
  std::vector<Look> looks;
  const auto csg = csg_of(inner, {}, {}, looks);
  return csg ? evaluated(*csg, looks, object) : std::vector<Piece>{};
}

}  // namespace vitrail::pov
