// SPDX-License-Identifier: Apache-2.0
// The directives that describe the world: materials, textures, lights, shapes and instances.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/pbrt/directives.h"

namespace vitrail::pbrt {

void Interpreter::reverse_orientation(const Place&) {
  state_.reverse_orientation = !state_.reverse_orientation;
}

// ---- Materials and textures ---------------------------------------------------------------------

// v4 lets materials name textures that come later; they wait for the end.
void Interpreter::define_material(std::uint32_t slot, const std::string& kind, ParameterSet parameters) {
  if (!textures_are_known(parameters, textures_)) {
    deferred_.push_back({slot, kind, state_.color_space, std::move(parameters)});
    return;
  }
  std::visit([&](auto&& made) { materials_[slot] = std::move(made); },
             make_material(kind, parameters, scope()));
}

void Interpreter::material(const Place& place) {
  const std::string kind = read_text("a kind of material");
  const auto slot = static_cast<std::uint32_t>(materials_.size());
  materials_.emplace_back();
  define_material(slot, kind, read_set("Material", kind, place, "material"));
  state_.material = Id<Material>{slot};
}

void Interpreter::make_named_material(const Place& place) {
  const std::string name = read_text("the name of a material");
  ParameterSet parameters = read_set("material", name, place, "material");
  if (!parameters.find("type", {ParameterType::text}))
    fail("a named material needs a \"string type\"", place);
  const std::string kind = parameters.text("type", "");
  const auto next = static_cast<std::uint32_t>(materials_.size());
  const auto [slot, redefined] = material_names_.define(name, place, next);
  if (slot == next) materials_.emplace_back();
  if (redefined)
    context_.report.approximated(
        fmt::format("material \"{}\" is defined again, for the shapes after it", name), place);
  define_material(slot, kind, std::move(parameters));
}

void Interpreter::named_material(const Place& place) {
  const std::string name = read_text("the name of a material");
  const auto next = static_cast<std::uint32_t>(materials_.size());
  const std::uint32_t slot = material_names_.use(name, place, next);
  if (slot == next) materials_.emplace_back();
  state_.material = Id<Material>{slot};
}

void Interpreter::texture(const Place& place) {
  const std::string name = read_text("the name of a texture"), type = read_text("the type of a texture"),
                    kind = read_text("a kind of texture");
  ParameterSet parameters = read_set("Texture", name, place, "texture");
  const bool spectral = type == "spectrum" || type == "color";
  if (!spectral && type != "float")
    fail(fmt::format("expected a texture of type float or spectrum, found \"{}\"", type), place);
  Texture made = make_texture(kind, spectral, parameters, scope());
  if (made.approximation.empty()) parameters.report_unused(context_.report);
  (spectral ? textures_.spectra : textures_.numbers).insert_or_assign(name, std::move(made));
}

void Interpreter::make_named_medium(const Place& place) {
  const std::string name = read_text("the name of a medium");
  read_set("medium", name, place);
  context_.report.dropped(fmt::format("medium \"{}\": media are not rendered", name), place);
}

void Interpreter::medium_interface(const Place&) {
  read_text("the name of a medium");
  if (tokens_.text_follows()) read_text("the name of a medium");
}

// ---- Lights -------------------------------------------------------------------------------------

void Interpreter::light_source(const Place& place) {
  const std::string kind = read_text("a kind of light");
  ParameterSet parameters = read_set("LightSource", kind, place, "light");
  if (auto light = make_light(kind, parameters, state_.ctm, scope()))
    scene_.lights.push_back(std::move(*light));
}

void Interpreter::area_light_source(const Place& place) {
  const std::string kind = read_text("a kind of light");
  ParameterSet parameters = read_set("AreaLightSource", kind, place, "light");
  state_.area_light = std::make_shared<AreaLightState>(
      AreaLightState{make_area_emission(kind, parameters, scope()), std::nullopt});
}

// The area in the world of each of the shapes that pbrt makes of a mesh, which all emit the whole power.
double Interpreter::area_per_part(const ShapeGeometry& geometry, const Place& place) {
  const TriangleMesh& mesh = scene_.meshes[geometry.mesh.value];
  double total = 0, least = INFINITY, greatest = 0;
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t i) {
      return transform_point(state_.ctm, cast<double>(mesh.positions[triangle[i]]));
    };
    const double area = length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
    total += area;
    least = std::min(least, area);
    greatest = std::max(greatest, area);
  }
  constexpr double tolerance = 1.001;
  if (geometry.parts > 1 && greatest > least * tolerance)
    context_.report.approximated("the power of an area light: all of the mesh gets the mean radiance", place);
  return total / static_cast<double>(geometry.parts);
}

std::optional<Id<AreaLight>> Interpreter::shape_light(const ShapeGeometry& geometry, const Place& place) {
  if (!state_.area_light) return std::nullopt;
  if (current_object_) {
    context_.report.dropped("area lights of objects that are instanced do not shine, as in pbrt", place);
    return std::nullopt;
  }
  AreaLightState& state = *state_.area_light;
  if (state.id && !(state.emission.power > 0)) return state.id;
  AreaLight light = state.emission.light;
  if (state.emission.power > 0) {
    const double area = area_per_part(geometry, place) * (light.two_sided ? 2 : 1);
    if (!(area > 0)) fail("an area light with a power needs a shape with an area", place);
    light.radiance = scaled(light.radiance, state.emission.power / (area * std::numbers::pi));
  }
  state.id = Id<AreaLight>{static_cast<std::uint32_t>(scene_.area_lights.size())};
  scene_.area_lights.push_back(std::move(light));
  area_light_places_.push_back(state.emission.place);
  return state.id;
}

// ---- Shapes and instances -----------------------------------------------------------------------

Id<Material> Interpreter::shape_material() {
  if (state_.material) return *state_.material;
  if (!default_material_) {
    default_material_ = Id<Material>{static_cast<std::uint32_t>(materials_.size())};
    materials_.emplace_back(Material{DiffuseMaterial{}});
  }
  return *default_material_;
}

void Interpreter::shape(const Place& place) {
  const std::string kind = read_text("a kind of shape");
  ParameterSet parameters = read_set("Shape", kind, place, "shape");
  const auto geometry = shapes_.make(kind, parameters);
  if (!geometry || scene_.meshes[geometry->mesh.value].triangles.empty()) return;
  Shape shape;
  shape.mesh = geometry->mesh;
  shape.material = shape_material();
  shape.area_light = shape_light(*geometry, place);
  shape.object_to_world = state_.ctm * vitrail::translate(geometry->offset);
  // Meshes: pbrt flips the winding normal of the world, so that the object's front stays the front. Analytic
  // shapes: it flips the normal of the object and then transforms it, so a mirror turns them inside out;
  // their light does not turn, and one that shines goes by its light.
  const bool mirrored = swaps_handedness(state_.ctm);
  shape.flip_orientation =
      state_.reverse_orientation != (mirrored && (!geometry->quadric || shape.area_light));
  if (mirrored && geometry->quadric && shape.area_light)
    context_.report.approximated("a mirrored shape that shines has its front where it shines", place);
  (current_object_ ? scene_.prototypes[*current_object_].shapes : scene_.shapes).push_back(std::move(shape));
}

void Interpreter::object_instance(const Place& place) {
  const std::string name = read_text("the name of an object");
  if (current_object_) fail("ObjectInstance inside of an object", place);
  const auto next = static_cast<std::uint32_t>(scene_.prototypes.size());
  const std::uint32_t slot = object_names_.use(name, place, next);
  if (slot == next) scene_.prototypes.push_back({});
  scene_.instances.push_back({Id<Prototype>{slot}, state_.ctm});
}

// ---- The end ------------------------------------------------------------------------------------

void Interpreter::resolve_materials() {
  for (DeferredMaterial& deferred : deferred_)
    std::visit(
        [&](auto&& made) { materials_[deferred.slot] = std::move(made); },
        make_material(deferred.kind, deferred.parameters, {{context_, deferred.color_space}, textures_}));
  for (std::size_t i = 0; i < materials_.size(); ++i) {
    std::size_t at = i;
    for (std::size_t steps = 0; const auto* other = std::get_if<MaterialAlias>(&materials_[at]); ++steps) {
      at = material_names_.use(other->name, other->place, static_cast<std::uint32_t>(materials_.size()));
      if (at == materials_.size()) material_names_.require_definitions();
      if (steps > materials_.size()) fail("this mix of materials contains itself", other->place);
    }
    if (const auto* material = std::get_if<Material>(&materials_[at]))
      scene_.materials.push_back(*material);
    else
      material_names_.require_definitions();
  }
}

// Without a surface there is nothing to emit; pbrt leaves such lights out.
void Interpreter::drop_lights_of_interfaces() {
  for (Shape& shape : scene_.shapes)
    if (shape.area_light &&
        std::holds_alternative<InterfaceMaterial>(scene_.materials[shape.material.value])) {
      context_.report.dropped("an area light on the material \"interface\" does not shine, as in pbrt",
                              area_light_places_[shape.area_light->value]);
      shape.area_light.reset();
    }
}

void Interpreter::resolve_instances() {
  object_names_.require_definitions();
  std::erase_if(scene_.instances, [&](const Instance& instance) {
    return scene_.prototypes[instance.prototype.value].shapes.empty();
  });
}

}  // namespace vitrail::pbrt
