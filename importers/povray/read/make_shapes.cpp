// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/povray/read/extents.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "importers/shapes/quadrics.h"
#include "importers/solids/primitives.h"
#include "scene/geometry/frame.h"

namespace vitrail::pov {

namespace {

// Takes +z to the vector, with its length; x and y get `radius`.
Transform along(Point3d from, Vector3d axis, double radius) {
  const double high = length(axis);
  return translate(from - Point3d{}) * transform_of(Frame(axis * (1 / high))) * scale({radius, radius, high});
}

// A sheet that lets all light through.
bool is_clear(const Material& material) {
  const auto* sheet = std::get_if<ThinDielectricMaterial>(&material.model);
  const auto* through = sheet ? std::get_if<Spectrum>(&sheet->transmittance_factor) : nullptr;
  if (!through || sheet->eta != Spectrum{ConstantSpectrum{1}}) return false;
  for (const double lambda_nm : {450.0, 550.0, 650.0})
    if (std::abs(evaluate(*through, lambda_nm) - 1) > 1e-3) return false;
  return true;
}

Numbers ambient_of(const World& world) {
  if (world.radiosity) return Finish::grey(0);
  return world.ambient_light.value_or(Finish::grey(1));
}

}  // namespace

SceneMaker::SceneMaker(Reader& reader, const World& world, MeshMemory& memory)
    : reader_(reader), world_(world), memory_(memory), surfaces_(reader, scene_, ambient_of(world)) {}

Scene SceneMaker::make() {
  for (const std::string& file : reader_.files()) scene_.files.push_back(file);
  Bounds3d box;
  for (const auto& object : world_.objects)
    if (const Bounds3d one = extents_of(*object); !one.empty() && length(extent(one)) < 1e7) extend(box, one);
  if (box.empty()) extend(box, Point3d{});  // planes alone
  extend(box, world_.camera ? Point3d{} + world_.camera->location : Point3d{});
  reach_ = 1000 * std::max(length(extent(box)), 1e-3);
  set_view();
  add_fog();
  add_atmosphere();
  const Target target{scene_.shapes, scene_.instances};
  for (const auto& object : world_.objects) add(*object, {}, {reader_.defaults.texture, {}, nullptr}, target);
  add_surroundings();
  if (eye_medium_) scene_.camera_medium = eye_medium_;
  return std::move(scene_);
}

Id<TriangleMesh> SceneMaker::add_mesh(TriangleMesh mesh) {
  scene_.meshes.push_back(memory_.keep(std::move(mesh), {}));
  return {static_cast<std::uint32_t>(scene_.meshes.size() - 1)};
}

Id<TriangleMesh> SceneMaker::quadric_mesh(const Quadric& quadric) {
  for (const auto& [known, mesh] : quadrics_)
    if (known == quadric) return mesh;
  const auto mesh = add_mesh(mesh_of(quadric));
  quadrics_.emplace_back(quadric, mesh);
  return mesh;
}

void SceneMaker::add(const Object& object, const Transform& parent_to_world, Look look, Target target) {
  if (object.texture) look.texture = object.texture, look.to_world = parent_to_world;
  if (object.interior)
    look.interior = object.interior, look.medium = media_of(object, *object.interior, parent_to_world);
  look.by_uv = look.by_uv || object.uv_mapping;
  const Transform to_world = parent_to_world * object.to_parent;
  if (const auto* light = std::get_if<LightShape>(&object.shape)) {
    if (&target.shapes != &scene_.shapes) return;
    add_light(object, *light, to_world);
    for (const auto& child : object.children)
      add(*child, to_world, {reader_.defaults.texture, {}, nullptr}, target);
    return;
  }
  if (object.no_shadow)
    reader_.notes.approximated("no_shadow: it has a shadow", reader_.location(object.place));
  if (object.no_image) {
    reader_.notes.dropped("an object with no_image", reader_.location(object.place));
    return;
  }
  if (!object.clipped_by.empty()) {
    for (const Piece& piece : clipped_pieces(object)) add_piece(object, piece, parent_to_world, look, target);
    return;
  }
  if (const auto* group = std::get_if<GroupShape>(&object.shape);
      group && (group->kind == Word::union_ || group->kind == Word::light_group_)) {
    if (group->kind == Word::light_group_)
      reader_.notes.approximated("light_group: its lights light all that is there",
                                 reader_.location(object.place));
    return add_group(object, to_world, look, target);
  }
  if (const auto* plane = std::get_if<PlaneShape>(&object.shape))
    return add_plane(object, *plane, to_world, look, target);
  const Object* const key = object.original ? object.original.get() : &object;
  auto known = pieces_.find(key);
  if (known == pieces_.end()) known = pieces_.emplace(key, pieces_of(object)).first;
  for (const Piece& piece : known->second) add_piece(object, piece, to_world, look, target);
}

void SceneMaker::add_group(const Object& object, const Transform& to_world, const Look& look, Target target) {
  for (const auto& child : object.children) {
    const bool plain = !look.texture || pov::is_plain(*look.texture);
    if (child->declared && std::holds_alternative<GroupShape>(child->shape) && plain && is_plain(*child) &&
        (!object.texture && !look.interior))
      if (const auto prototype = prototype_of(child)) {
        target.instances.push_back({*prototype, to_world, origin(object.place)});
        continue;
      }
    add(*child, to_world, look, target);
  }
}

bool SceneMaker::is_plain(const Object& object) {
  if (const auto known = plain_.find(&object); known != plain_.end()) return known->second;
  bool plain = !std::holds_alternative<LightShape>(object.shape) &&
               !std::holds_alternative<PlaneShape>(object.shape) &&
               (!object.texture || pov::is_plain(*object.texture)) &&
               (!object.interior || object.interior->media.empty());
  if (const auto* mesh = std::get_if<MeshShape>(&object.shape))
    for (const auto& part : mesh->parts) plain = plain && (!part.texture || pov::is_plain(*part.texture));
  for (const auto& child : object.children) plain = plain && is_plain(*child);
  return plain_[&object] = plain;
}

std::optional<Id<Prototype>> SceneMaker::prototype_of(const Shared<Object>& object) {
  if (const auto known = prototypes_.find(object.get()); known != prototypes_.end()) return known->second;
  Prototype prototype;
  prototype.origin = origin(object->place);
  add(*object, {}, {reader_.defaults.texture, {}, nullptr}, {prototype.shapes, prototype.instances});
  std::optional<Id<Prototype>> made;
  if (!prototype.shapes.empty() || !prototype.instances.empty()) {
    scene_.prototypes.push_back(std::move(prototype));
    made = Id<Prototype>{static_cast<std::uint32_t>(scene_.prototypes.size() - 1)};
  }
  return prototypes_[object.get()] = made;
}

// A disc around the point below the camera: of what it leaves out at the horizon, a pixel is more.
void SceneMaker::add_plane(const Object& object, const PlaneShape& plane, const Transform& to_world,
                           const Look& look, Target target) {
  const Normal3d n = transform_normal(to_world, to_normal(plane.normal));
  const Vector3d normal = normalize(to_vector(n));
  const Point3d on = transform_point(to_world, Point3d{} + plane.normal * plane.distance);
  const Point3d eye = world_.camera ? Point3d{} + world_.camera->location : Point3d{};
  const double height = dot(eye - on, normal);
  const Point3d foot = eye - normal * height;
  const double radius = std::max(reach_, 1000 * std::abs(height));
  Piece piece{quadric_mesh({QuadricKind::disk, QuadricUv::pbrt, 0, 1}), along(foot, normal, radius), {}};
  reader_.notes.approximated("plane: a disc that reaches a thousand times as far as all else",
                             reader_.location(object.place));
  add_piece(object, piece, {}, look, target);
}

void SceneMaker::add_piece(const Object& object, const Piece& piece, const Transform& to_world,
                           const Look& look, Target target) {
  Look own = look;
  if (piece.look && piece.look->texture) {
    own.texture = piece.look->texture;
    own.to_world = to_world * piece.look->to_world;
  }
  if (piece.look && piece.look->interior) own.interior = piece.look->interior;
  const Surface surface = surfaces_.of(own);
  Shape shape;
  shape.mesh = piece.mesh;
  shape.material = surface.material;
  shape.area_light = surface.glow;
  shape.opacity = surface.opacity;
  shape.object_to_world = to_world * piece.to_object;
  shape.flip_orientation = !piece.faces_out != object.inverse;
  shape.origin = origin(object.place);
  if (own.medium) fill(shape, *own.medium);
  if (is_invertible(shape.object_to_world)) target.shapes.push_back(std::move(shape));
}

void SceneMaker::fill(Shape& shape, Id<Medium> medium) {
  shape.interior = medium, shape.exterior = scene_.camera_medium;
  if (is_clear(scene_.materials[shape.material.value])) shape.opacity = 0.0f;  // `rgbf 1`
  if (shape.opacity == FloatParameter{1.0f}) return;
  const auto added = [&](MaterialModel model) {
    Material material;
    material.model = std::move(model);
    material.origin = shape.origin;
    scene_.materials.push_back(std::move(material));
    return Id<Material>{static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  };
  const Id<Material> nothing = added(InterfaceMaterial{});
  if (shape.opacity == FloatParameter{0.0f}) {
    shape.material = nothing;
    shape.area_light.reset();
  } else {
    shape.material = added(BlendMaterial{nothing, shape.material, shape.opacity});
  }
  shape.opacity = 1.0f;
}

std::vector<SceneMaker::Piece> SceneMaker::pieces_of(const Object& object) {
  if (const auto* s = std::get_if<SphereShape>(&object.shape)) {
    if (!(s->radius > 0)) return {};
    return {{quadric_mesh({QuadricKind::sphere}),
             translate(s->center - Point3d{}) * scale({s->radius, s->radius, s->radius}),
             {}}};
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
    if (size.x == 0 || size.y == 0 || size.z == 0) {
      reader_.notes.dropped("a box without volume", reader_.location(object.place));
      return {};
    }
    return {{add_mesh(solids::mesh_of(solids::box(s->corner1, s->corner2))), {}, {}}};
  }
  if (const auto* s = std::get_if<MeshShape>(&object.shape)) {
    std::vector<Piece> pieces;
    for (const MeshShape::Part& part : s->parts)
      if (!part.mesh->triangles.empty()) {
        Piece piece{add_mesh(*part.mesh), {}, {}};
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
      return {{add_mesh(std::move(mesh)), {}, {}}};
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
