// SPDX-License-Identifier: Apache-2.0
// The directives of shapes and instances.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "importers/pbrt/read/directives.h"
#include "importers/pbrt/read/turning_motion.h"
#include "scene/records/material_traits.h"

namespace vitrail::pbrt {

void Interpreter::reverse_orientation(const Place&) {
  state_.reverse_orientation = !state_.reverse_orientation;
}

Id<Material> Interpreter::shape_material() {
  if (state_.material) return *state_.material;
  if (!default_material_) {
    default_material_ = Id<Material>{add_material(Material{DiffuseMaterial{}})};
  }
  return *default_material_;
}

// In v3 the colours and textures of a shape are those of its material, too.
std::optional<Id<Material>> Interpreter::overridden_material(ParameterSet& shape, const Place& place) {
  const auto given = state_.material ? given_.find(state_.material->value) : given_.end();
  if (given == given_.end()) return std::nullopt;
  std::vector<Parameter> all = given->second.parameters, own;
  for (const Parameter& p : shape.all()) {
    const bool is_color = p.type == ParameterType::rgb || p.type == ParameterType::xyz ||
                          p.type == ParameterType::blackbody || p.type == ParameterType::spectrum;
    const bool is_texture = p.type == ParameterType::texture && p.name != "alpha" && p.name != "shadowalpha";
    if (is_color || is_texture) own.push_back(p);
  }
  if (own.empty()) return std::nullopt;
  for (const Parameter& p : own) {
    shape.ignore({p.name});
    std::erase_if(all, [&](const Parameter& of_material) { return of_material.name == p.name; });
  }
  all.insert(all.end(), own.begin(), own.end());
  const std::string kind = given->second.kind;
  const std::uint32_t slot = new_material_slot();
  define_material(slot, kind, {fmt::format("Material \"{}\"", kind), place, std::move(all)}, place);
  return Id<Material>{slot};
}

// v4 goes by shares; to v3 a surface is there wherever its alpha is not 0.
FloatParameter Interpreter::shape_opacity(ParameterSet& parameters, const Place& place) {
  const FloatParameter alpha = float_parameter(parameters, {"alpha"}, 1, scope(place));
  const bool v3 = context_.version == Version::v3;
  if (const auto* constant = std::get_if<float>(&alpha))
    return v3 && *constant != 0 ? 1.0f : std::clamp(*constant, 0.0f, 1.0f);
  if (v3 && shares_of_v3_.insert(std::get<Id<Texture>>(alpha).value).second)
    context_.report.approximated(
        "v3 shows all of a surface where its alpha is not 0; here alpha is the share of it that is there",
        place);
  return alpha;
}

void Interpreter::report_shining_alpha(const FloatParameter& alpha, const Place& place) {
  if (context_.version == Version::v3)
    context_.report.approximated("the alpha of a light: in v3 what is not there lights other things", place);
  else if (alpha != FloatParameter{0.0f})
    context_.report.approximated(
        "the alpha of a light: where it is between 0 and 1 pbrt shows the light times its square", place);
}

// Of the next shape; a material that is not known yet may look them up.
bool Interpreter::uvs_show(const FloatParameter& opacity) {
  if (uv_uses_.of(opacity) || (state_.area_light && uv_uses_.of(state_.area_light->emission.light.radiance)))
    return true;
  return state_.material && std::ranges::any_of(with_parts(*state_.material), [&](Id<Material> part) {
           return !material_is_made_[part.value] || uv_uses_.of(materials_[part.value]);
         });
}

// What a shape's material is made of decides for every shape.
constexpr std::size_t most_looked_at = 1024;

// The material and what it is made of as far as that is known, each once. There may be cycles yet.
std::vector<Id<Material>> Interpreter::with_parts(Id<Material> id) const {
  std::vector<Id<Material>> found{id};
  std::set<std::uint32_t> seen{id.value};
  for (std::size_t i = 0; i < found.size() && i < most_looked_at; ++i)
    if (material_is_made_[found[i].value])
      for (const Id<Material> part : parts_of(materials_[found[i].value].model))
        if (seen.insert(part.value).second) found.push_back(part);
  return found;
}

// Whether the material, or a part of it, is hair; of one that is not known yet that is not known either.
bool Interpreter::meets_hair(Id<Material> id) const {
  return std::ranges::any_of(with_parts(id), [&](Id<Material> part) {
    return material_is_made_[part.value] &&
           std::holds_alternative<HairMaterial>(materials_[part.value].model);
  });
}

void Interpreter::shape(const Place& place) {
  const std::string kind = read_text("a kind of shape");
  ParameterSet parameters = read_set("Shape", kind, place, "shape");
  const FloatParameter opacity = shape_opacity(parameters, place);
  if (opacity == FloatParameter{0.0f} && !state_.area_light) return;  // nothing shows
  const std::optional<Id<Material>> before = state_.material;
  if (const auto own = overridden_material(parameters, place)) state_.material = own;
  const bool faces_show = std::ranges::any_of(
      scene_.textures, [](const Texture& t) { return std::holds_alternative<PtexTexture>(t.model); });
  for (const ShapeGeometry& geometry : shapes_.make(kind, parameters, uvs_show(opacity), faces_show))
    if (triangles_of(scene_.meshes[geometry.mesh.value]) > 0) add_shape(geometry, opacity, place);
  state_.material = before;
}

void Interpreter::add_shape(const ShapeGeometry& geometry, const FloatParameter& opacity,
                            const Place& place) {
  Shape shape;
  shape.mesh = geometry.mesh;
  shape.material = shape_material();
  shape.opacity = opacity;
  shape.interior = state_.interior;
  shape.exterior = state_.exterior;
  shape.origin = origin(place);
  shape.area_light = shape_light(geometry, place);
  if (opacity == FloatParameter{0.0f} && !shape.area_light) return;
  if (shape.area_light && opacity != FloatParameter{1.0f}) report_shining_alpha(opacity, place);
  const Placing& at = placing(place);
  const bool moves = at.motion.has_value();
  shape.object_to_world = moves ? geometry.mesh_to_object : at.at_open * geometry.mesh_to_object;
  // Meshes: pbrt flips the winding normal of the world, so that the object's front stays the front. Analytic
  // shapes: it flips the normal of the object and then transforms it, so a mirror turns them inside out;
  // their light does not turn, and one that shines goes by its light.
  const bool mirrored = !moves && swaps_handedness(at.at_open);
  shape.flip_orientation =
      state_.reverse_orientation != (mirrored && (!geometry.quadric || shape.area_light));
  if (meets_hair(shape.material)) {
    if (geometry.curve)
      shape.flip_orientation = mirrored;  // hair is met from outside, whatever a file says
    else
      context_.report.approximated(
          "hair on what is no round or flat curve: it shows from the front alone, and where light meets its "
          "width goes by the normal, not by v",
          place);
  }
  if (mirrored && geometry.quadric && shape.area_light)
    context_.report.approximated("a mirrored shape that shines has its front where it shines", place);
  std::vector<Shape>& shapes = moves             ? scene_.prototypes[moving_prototype(at, place).value].shapes
                               : current_object_ ? scene_.prototypes[*current_object_].shapes
                                                 : scene_.shapes;
  if (geometry.curve) {
    quadric_runs_.add_curve(scene_, shapes, std::move(shape));
  } else if (&shapes == &scene_.shapes && context_.mesh_memory.is_limited()) {
    quadric_runs_.add(scene_, std::move(shape));
  } else {
    shapes.push_back(std::move(shape));
  }
}

void Interpreter::object_instance(const Place& place) {
  const std::string name = read_text("the name of an object");
  const auto next = static_cast<std::uint32_t>(scene_.prototypes.size());
  const std::uint32_t slot = object_names_.use(name, place, next);
  // pbrt itself has no instances within objects.
  if (current_object_ && slot >= *current_object_)
    fail(fmt::format("object \"{}\" has to be defined before the object that it is used in", name), place);
  if (slot == next) scene_.prototypes.push_back({});
  auto& instances = current_object_ ? scene_.prototypes[*current_object_].instances : scene_.instances;
  const Placing& at = placing(place);
  if (at.motion && turns(scene_.motions[at.motion->value]))
    context_.report.approximated(turned_by_camera, place);
  instances.push_back({Id<Prototype>{slot}, at.at_open, origin(place), at.motion});
}

// Of which the one instance is moved so.
Id<Prototype> Interpreter::moving_prototype(const Placing& at, const Place& place) {
  std::optional<Id<Prototype>>& moved = last_placing_.moved;
  if (moved) return *moved;
  moved = Id<Prototype>{static_cast<std::uint32_t>(scene_.prototypes.size())};
  scene_.prototypes.push_back({.name = "", .shapes = {}, .instances = {}, .origin = origin(place)});
  scene_.instances.push_back({*moved, at.at_open, origin(place), at.motion});
  return *moved;
}

}  // namespace vitrail::pbrt
