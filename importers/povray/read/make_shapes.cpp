// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "importers/povray/read/extents.h"
#include "importers/povray/read/loose_faces.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "importers/shapes/quadrics.h"
#include "scene/geometry/frame.h"
#include "scene/records/material_traits.h"

namespace vitrail::pov {

namespace {

// The pigment of an image around a sphere, or none.
const Pigment* wrapped_image(const pov::Texture& texture) {
  const Pigment* const pigment = texture.pigment.get();
  return pigment && pigment->pattern.image && pigment->pattern.image->map_type == 1 ? pigment : nullptr;
}

// Turns a sphere's own (u,v), whose pole is +z, to where an image around it lies: its pole is +y, its left
// edge at +x, and u runs backwards (make_textures.cpp). `image_to_sphere` counts where it is a rotation and a
// scale.
Transform turned_to_image(const Transform& image_to_sphere) {
  Transform turn;
  std::array<double, 3> size{};
  for (std::size_t k = 0; k < 3; ++k)
    size[k] = length(
        transform_vector(image_to_sphere, Vector3d{k == 0 ? 1.0 : 0, k == 1 ? 1.0 : 0, k == 2 ? 1.0 : 0}));
  const bool even = std::abs(size[0] - size[1]) + std::abs(size[0] - size[2]) < 1e-6 * size[0];
  if (even && !swaps_handedness(image_to_sphere))
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t k = 0; k < 3; ++k) turn.m[row][k] = image_to_sphere.m[row][k] / size[k];
  Transform pole;
  pole.m[1] = {0, 0, 1, 0};
  pole.m[2] = {0, -1, 0, 0};
  return turn * pole;
}

// Turns a sphere's own (u,v) to POV-Ray's: around +y, from +x towards +z.
Transform turned_to_y() {
  Transform t;
  t.m[1] = {0, 0, 1, 0};
  t.m[2] = {0, 1, 0, 0};
  return t;
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

// Whether its surface is closed, as far as that is known.
bool is_closed(const Object& object) {
  if (!object.clipped_by.empty()) return false;
  if (const auto* mesh = std::get_if<MeshShape>(&object.shape)) return mesh->closed;
  if (const auto* box = std::get_if<BoxShape>(&object.shape)) {
    const Vector3d size = box->corner2 - box->corner1;
    return size.x != 0 && size.y != 0 && size.z != 0;
  }
  if (const auto* cone = std::get_if<ConeShape>(&object.shape)) return !cone->open;
  if (const auto* solid = std::get_if<SolidShape>(&object.shape)) return !solid->patch;
  return !std::holds_alternative<DiscShape>(object.shape);
}

// Whether its normals, as it is made, look to its inside.
bool faces_in(const Object& object, const Transform& to_world) {
  const auto* const mesh = std::get_if<MeshShape>(&object.shape);
  const auto* const solid = std::get_if<SolidShape>(&object.shape);
  const bool clockwise = (mesh && mesh->clockwise) || (solid && solid->patch);
  return clockwise != swaps_handedness(to_world);
}

Numbers ambient_of(const World& world) {
  if (world.radiosity) return Finish::grey(0);
  return world.ambient_light.value_or(Finish::grey(1));
}

}  // namespace

SceneMaker::SceneMaker(Reader& reader, const World& world, MeshMemory& memory)
    : reader_(reader),
      world_(world),
      memory_(memory),
      surfaces_(reader, scene_, ambient_of(world), !reader.for_export && !world.photons) {}

Scene SceneMaker::make() {
  for (const std::string& file : reader_.files()) scene_.files.push_back(file);
  Bounds3d box;
  for (const Placed& placed : world_.objects)
    if (const Bounds3d one = extents_of(*placed.object); !one.empty() && length(extent(one)) < 1e7)
      extend(box, one);
  if (box.empty()) extend(box, Point3d{});  // planes alone
  extend(box, world_.camera ? Point3d{} + world_.camera->location : Point3d{});
  reach_ = 1000 * std::max(length(extent(box)), 1e-3);
  set_view();
  add_fog();
  add_atmosphere();
  const Target target{scene_.shapes, scene_.instances};
  for (const Placed& placed : world_.objects) {
    default_texture_ = placed.default_texture;
    add(*placed.object, {}, {default_texture_, {}, nullptr}, target);
  }
  hide_lamps();
  add_lamps();
  add_surroundings();
  set_eye_medium();
  turn_glass_out(scene_, scene_.shapes);
  for (const Prototype& prototype : scene_.prototypes) turn_glass_out(scene_, prototype.shapes);
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
  if (object.texture || object.interior_texture)
    look.interior_texture = object.interior_texture, look.interior_to_world = parent_to_world;
  if (object.interior)
    look.interior = object.interior, look.medium = media_of(object, *object.interior, parent_to_world);
  look.by_uv = look.by_uv || object.uv_mapping;
  const Transform to_world = parent_to_world * object.to_parent;
  if (const auto* light = std::get_if<LightShape>(&object.shape)) {
    if (&target.shapes != &scene_.shapes) return;
    add_light(object, *light, to_world);
    for (const auto& child : object.children) {
      Look lamp{default_texture_, {}, nullptr};
      lamp.no_shadow = lamp.of_lamp = true;
      add(*child, to_world, lamp, target);
    }
    return;
  }
  look.no_shadow = look.no_shadow || object.no_shadow;
  look.hollow = look.hollow || object.hollow;
  look.double_illuminate = look.double_illuminate || object.double_illuminate;
  look.no_image = look.no_image || object.no_image;
  if (hides_surroundings(object)) return void(sees_around_ = false);
  if (object.no_reflection && !object.no_image)
    reader_.notes.approximated("no_reflection: mirrors show the object", reader_.location(object.place));
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
    const auto plain = [](const Shared<pov::Texture>& texture) {
      return !texture || pov::is_plain(*texture);
    };
    if (child->declared && std::holds_alternative<GroupShape>(child->shape) && is_plain(*child) &&
        plain(look.texture) && plain(look.interior_texture) && !look.interior && !look.of_lamp)
      if (const auto prototype = prototype_of(child, look)) {
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
               (!object.interior || !has_medium(*object.interior));
  if (const auto* mesh = std::get_if<MeshShape>(&object.shape))
    for (const auto& part : mesh->parts) plain = plain && (!part.texture || pov::is_plain(*part.texture));
  for (const auto& child : object.children) plain = plain && is_plain(*child);
  return plain_[&object] = plain;
}

std::optional<Id<Prototype>> SceneMaker::prototype_of(const Shared<Object>& object, const Look& look) {
  const Worn key{object.get(),  look.texture.get(), look.interior_texture.get(), look.by_uv, look.no_shadow,
                 look.no_image, look.hollow,        look.double_illuminate};
  if (const auto known = prototypes_.find(key); known != prototypes_.end()) return known->second;
  Prototype prototype;
  prototype.origin = origin(object->place);
  add(*object, {}, look, {prototype.shapes, prototype.instances});
  std::optional<Id<Prototype>> made;
  if (!prototype.shapes.empty() || !prototype.instances.empty()) {
    scene_.prototypes.push_back(std::move(prototype));
    made = Id<Prototype>{static_cast<std::uint32_t>(scene_.prototypes.size() - 1)};
  }
  return prototypes_[key] = made;
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
  const Transform to_foot =
      translate(foot - Point3d{}) * transform_of(Frame(normal)) * scale({radius, radius, 1});
  Piece piece{quadric_mesh({QuadricKind::disk, QuadricUv::pbrt, 0, 1}), to_foot, {}};
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
    if (piece.look->texture != look.texture) own.interior_texture = nullptr;
  }
  if (piece.look && piece.look->interior) own.interior = piece.look->interior;
  own.uvs_are_places = reader_.has_uv_mapping && !piece.has_uvs;
  const Surface whole = surfaces_.of(own);
  Surface surface = surfaces_.of_sides(own, object.place);
  const bool has_sides = surface.material != whole.material || surface.glow != whole.glow;
  if (own.no_shadow && reader_.for_export) surface = without_shadow(surface, own.of_lamp, object);
  if (own.no_shadow && !reader_.for_export) surface.material = shadowless(surface.material);
  Shape shape;
  shape.mesh = piece.mesh;
  shape.material = surface.material;
  shape.area_light = surface.glow;
  shape.opacity = surface.opacity;
  shape.object_to_world = to_world * piece.to_object;
  const bool is_sphere =
      std::holds_alternative<SphereShape>(object.shape) && scene_.meshes[piece.mesh.value].quadric;
  if (const Pigment* const image = own.texture ? wrapped_image(*own.texture) : nullptr;
      image && is_sphere && is_invertible(to_world))
    shape.object_to_world =
        shape.object_to_world *
        turned_to_image(inverse(to_world) * own.to_world * own.texture->to_object * image->to_object);
  else if (reader_.has_uv_mapping && is_sphere)
    shape.object_to_world = shape.object_to_world * turned_to_y();
  shape.flip_orientation = !piece.faces_out != object.inverse;
  if (has_sides && faces_in(object, to_world * piece.to_object))
    shape.flip_orientation = !shape.flip_orientation;
  shape.origin = origin(object.place);
  if (own.medium && (own.hollow || lets_light_in(shape)))
    fill(shape, *own.medium);
  else if (atmosphere_ && !own.hollow && is_closed(object) && lets_light_in(shape))
    fill(shape, std::nullopt);
  if (is_invertible(shape.object_to_world) && is_there(own, shape.area_light.has_value(), object, target))
    target.shapes.push_back(std::move(shape));
}

Id<Material> SceneMaker::shadowless(Id<Material> material) {
  const auto [known, is_new] = shadowless_.try_emplace(material.value, material);
  if (is_new) {
    known->second = {static_cast<std::uint32_t>(scene_.materials.size())};
    Material copy = scene_.materials[material.value];
    copy.casts_shadow = false;
    scene_.materials.push_back(std::move(copy));
  }
  return known->second;
}

Surface SceneMaker::without_shadow(Surface surface, bool of_lamp, const Object& object) {
  const SourceLocation place = reader_.location(object.place);
  const auto* const diffuse = std::get_if<DiffuseMaterial>(&scene_.materials[surface.material.value].model);
  const auto* const reflects = diffuse ? std::get_if<Spectrum>(&diffuse->reflectance) : nullptr;
  const bool only_glows = surface.glow && reflects && luminance(*reflects) == 0;
  if (!only_glows && !(of_lamp && surface.glow)) {
    reader_.notes.approximated("no_shadow: it has a shadow", place);
    return surface;
  }
  reader_.notes.approximated("no_shadow: light passes it, and what is behind shows through", place);
  if (!clear_sheet_) {
    ThinDielectricMaterial sheet;
    sheet.eta = ConstantSpectrum{1};
    Material clear;
    clear.model = sheet;
    scene_.materials.push_back(std::move(clear));
    clear_sheet_ = Id<Material>{static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  }
  surface.material = *clear_sheet_;
  if (of_lamp) {  // seen through its front, its back would glow a second time
    AreaLight front = scene_.area_lights[surface.glow->value];
    front.two_sided = false;
    scene_.area_lights.push_back(std::move(front));
    surface.glow = Id<AreaLight>{static_cast<std::uint32_t>(scene_.area_lights.size() - 1)};
  }
  return surface;
}

void SceneMaker::fill(Shape& shape, std::optional<Id<Medium>> medium) {
  shape.interior = medium, shape.exterior = atmosphere_;
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

bool SceneMaker::lets_light_in(const Shape& shape) const {
  const auto transmits = [&](const auto& self, Id<Material> id) -> bool {
    const MaterialModel& model = scene_.materials[id.value].model;
    const auto part = [&](Id<Material> of) { return self(self, of); };
    return traits_of(model).transmits || std::ranges::any_of(parts_of(model), part);
  };
  return shape.opacity != FloatParameter{1.0f} || transmits(transmits, shape.material);
}

}  // namespace vitrail::pov
