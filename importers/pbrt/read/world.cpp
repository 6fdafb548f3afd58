// SPDX-License-Identifier: Apache-2.0
// The directives that describe the world: materials, textures, lights, shapes and instances.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/pbrt/read/directives.h"
#include "importers/pbrt/read/image_power.h"
#include "scene/records/material_traits.h"
#include "scene/records/nesting_limits.h"

namespace vitrail::pbrt {

void Interpreter::reverse_orientation(const Place&) {
  state_.reverse_orientation = !state_.reverse_orientation;
}

// ---- Materials and textures ---------------------------------------------------------------------

std::uint32_t Interpreter::new_material_slot() {
  materials_.emplace_back();
  material_is_made_.push_back(false);
  return static_cast<std::uint32_t>(materials_.size() - 1);
}

void Interpreter::set_material(std::uint32_t slot, Material material) {
  materials_[slot] = std::move(material);
  material_is_made_[slot] = true;
}

std::uint32_t Interpreter::add_material(Material material) {
  const auto slot = new_material_slot();
  set_material(slot, std::move(material));
  return slot;
}

Material Interpreter::made_material(const std::string& kind, ParameterSet& parameters, const Scope& scope) {
  const auto named = [&](const std::string& name) {
    const auto next = static_cast<std::uint32_t>(materials_.size());
    const std::uint32_t slot = material_names_.use(name, parameters.place(), next);
    if (slot == next) new_material_slot();
    return Id<Material>{slot};
  };
  const auto add = [&](Material material) {
    material.origin = scope.origin;
    return Id<Material>{add_material(std::move(material))};
  };
  return make_material(kind, parameters, scope, {named, add});
}

// v4 lets materials name textures that come later; they wait for the end.
void Interpreter::define_material(std::uint32_t slot, const std::string& kind, ParameterSet parameters,
                                  const Place& place) {
  if (context_.version == Version::v3) given_.insert_or_assign(slot, GivenMaterial{kind, parameters.all()});
  if (!textures_are_known(parameters, textures_)) {
    deferred_.push_back({slot, kind, state_.color_space, std::move(parameters), place});
    return;
  }
  set_material(slot, made_material(kind, parameters, scope(place)));
}

void Interpreter::material(const Place& place) {
  const std::string kind = read_text("a kind of material");
  const std::uint32_t slot = new_material_slot();
  define_material(slot, kind, read_set("Material", kind, place, "material"), place);
  state_.material = Id<Material>{slot};
}

void Interpreter::make_named_material(const Place& place) {
  const std::string name = read_text("the name of a material");
  ParameterSet parameters = read_set("material", name, place, "material");
  if (!parameters.find("type", {ParameterType::text}))
    fail("a named material needs a \"string type\"", place);
  const std::string kind = parameters.text("type", "");
  const auto next = static_cast<std::uint32_t>(materials_.size());
  if (names_end_with_block())
    saved_.back().undo.push_back(
        [this, before = material_names_.before(name)] { material_names_.end(before); });
  const auto [slot, redefined] = material_names_.define(name, place, next);
  if (slot == next) new_material_slot();
  // v4 refuses it; v3 warns.
  if (redefined && context_.version == Version::v4)
    context_.report.approximated(
        fmt::format("material \"{}\" is defined again, for the shapes after it", name), place);
  named_slots_[slot] = name;
  define_material(slot, kind, std::move(parameters), place);
}

void Interpreter::named_material(const Place& place) {
  const std::string name = read_text("the name of a material");
  if (material_names_.has_ended(name))
    return context_.report.approximated(
        fmt::format("material \"{}\" ended with its block: as in pbrt-v3, the one before it stays", name),
        place);
  const auto next = static_cast<std::uint32_t>(materials_.size());
  const std::uint32_t slot = material_names_.use(name, place, next);
  if (slot == next) new_material_slot();
  state_.material = Id<Material>{slot};
}

void Interpreter::texture(const Place& place) {
  const std::string name = read_text("the name of a texture"), type = read_text("the type of a texture"),
                    kind = read_text("a kind of texture");
  ParameterSet parameters = read_set("Texture", name, place, "texture");
  const bool spectral = type == "spectrum" || type == "color";
  report_held("a texture", place);
  if (!spectral && type != "float")
    fail(fmt::format("expected a texture of type float or spectrum, found \"{}\"", type), place);
  if (spectral)
    define_texture(textures_.spectra, name,
                   make_spectrum_texture(kind, name, parameters, state_.ctm, scope(place)));
  else
    define_texture(textures_.numbers, name,
                   make_float_texture(kind, name, parameters, state_.ctm, scope(place)));
}

template <class Table>
void Interpreter::define_texture(Table& table, const std::string& name, typename Table::mapped_type value) {
  if (names_end_with_block()) {
    const auto known = table.find(name);
    std::optional<typename Table::mapped_type> before;
    if (known != table.end()) before = known->second;
    saved_.back().undo.push_back([&table, name, before = std::move(before)] {
      if (before)
        table.insert_or_assign(name, *before);
      else
        table.erase(name);
    });
  }
  table.insert_or_assign(name, std::move(value));
}

// ---- Media --------------------------------------------------------------------------------------

void Interpreter::make_named_medium(const Place& place) {
  const std::string name = read_text("the name of a medium");
  ParameterSet parameters = read_set("medium", name, place, "medium");
  const std::string kind = parameters.text("type", "homogeneous");
  report_held("a medium", place);
  Medium medium = make_medium(kind, name, parameters, state_.ctm, scope(place));
  const auto next = static_cast<std::uint32_t>(media_.size());
  const auto [slot, redefined] = medium_names_.define(name, place, next);
  if (redefined)
    context_.report.approximated(fmt::format("medium \"{}\" is defined again, for what follows", name),
                                 place);
  if (slot == next) media_.emplace_back();
  media_[slot] = std::move(medium);
}

std::optional<Id<Medium>> Interpreter::medium_named(const std::string& name, const Place& place) {
  if (name.empty()) return std::nullopt;
  const auto next = static_cast<std::uint32_t>(media_.size());
  const std::uint32_t slot = medium_names_.use(name, place, next);
  if (slot == next) media_.emplace_back();
  return Id<Medium>{slot};
}

// One name stands for both sides.
void Interpreter::medium_interface(const Place& place) {
  const std::string inside = read_text("the name of a medium");
  const std::string outside = tokens_.text_follows() ? read_text("the name of a medium") : inside;
  state_.interior = medium_named(inside, place);
  state_.exterior = medium_named(outside, place);
}

// ---- Lights -------------------------------------------------------------------------------------

void Interpreter::light_source(const Place& place) {
  const std::string kind = read_text("a kind of light");
  ParameterSet parameters = read_set("LightSource", kind, place, "light");
  report_held("a light", place);
  if (auto light = make_light(kind, parameters, state_.ctm, scope(place)))
    scene_.lights.push_back(std::move(*light));
}

void Interpreter::area_light_source(const Place& place) {
  const std::string kind = read_text("a kind of light");
  ParameterSet parameters = read_set("AreaLightSource", kind, place, "light");
  state_.area_light = std::make_shared<AreaLightState>(
      AreaLightState{make_area_emission(kind, parameters, scope(place)), std::nullopt});
}

// The area in the world of each of the shapes that pbrt makes of a mesh, which all emit the whole power.
double Interpreter::area_per_part(const ShapeGeometry& geometry, const Place& place) {
  TriangleMesh storage;
  const TriangleMesh& stored = scene_.meshes[geometry.mesh.value];
  if (stored.quadric && !geometry.curve)
    return area_of(*stored.quadric, state_.ctm * geometry.mesh_to_object);
  const TriangleMesh& mesh = loaded(stored, storage);
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

std::optional<double> Interpreter::mean_of_image(Id<Texture> texture) {
  const auto [known, is_new] = image_means_.try_emplace(texture.value);
  if (is_new) known->second = mean_luminance(std::get<ImageTexture>(scene_.textures.at(texture.value).model));
  return known->second;
}

std::optional<Id<AreaLight>> Interpreter::shape_light(const ShapeGeometry& geometry, const Place& place) {
  if (!state_.area_light) return std::nullopt;
  if (current_object_) {
    context_.report.dropped("area lights of objects that are instanced do not shine, as in pbrt", place);
    return std::nullopt;
  }
  if (placing(place).motion) {
    context_.report.dropped("area lights that move do not shine: as in pbrt-v3, and v4 refuses them", place);
    return std::nullopt;
  }
  AreaLightState& state = *state_.area_light;
  if (state.id && !(state.emission.power > 0)) return state.id;
  AreaLight light = state.emission.light;
  if (state.emission.power > 0) {
    const double area = area_per_part(geometry, place) * (light.two_sided ? 2 : 1);
    if (!(area > 0)) fail("an area light with a power needs a shape with an area", place);
    const double factor = state.emission.power / (area * std::numbers::pi);
    if (const auto* radiance = std::get_if<Spectrum>(&light.radiance))
      light.radiance = scaled(*radiance, factor);
    else if (const auto mean = mean_of_image(std::get<Id<Texture>>(light.radiance)))
      light.scale = static_cast<float>(static_cast<double>(light.scale) * factor / *mean);
    else
      context_.report.approximated(
          "the power of an area light whose image is black or cannot be read: the image counts by its scale",
          place);
  }
  // An equal one that came not long ago is shared.
  constexpr std::size_t looked_back = 16;
  const std::size_t count = scene_.area_lights.size();
  for (std::size_t i = count; i-- > count - std::min(count, looked_back);)
    if (scene_.area_lights[i] == light) return state.id = Id<AreaLight>{static_cast<std::uint32_t>(i)};
  state.id = Id<AreaLight>{static_cast<std::uint32_t>(count)};
  scene_.area_lights.push_back(std::move(light));
  area_light_places_.push_back(state.emission.place);
  return state.id;
}

// ---- Shapes and instances -----------------------------------------------------------------------

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

// ---- The end ------------------------------------------------------------------------------------

namespace {

// Calls `use` with each material that `material` refers to.
template <class Use>
void for_each_reference(Material& material, Use&& use) {
  if (auto* blend = std::get_if<BlendMaterial>(&material.model)) use(blend->first), use(blend->second);
  if (auto* mask = std::get_if<MaskMaterial>(&material.model)) use(mask->material);
  if (auto* sided = std::get_if<TwoSidedMaterial>(&material.model)) use(sided->front), use(sided->back);
}

bool is_in_order(std::vector<Material>& materials) {
  bool in_order = true;
  for (std::uint32_t i = 0; i < materials.size(); ++i)
    for_each_reference(materials[i], [&](const Id<Material>& id) { in_order = in_order && id.value < i; });
  return in_order;
}

// Materials in an order in which each comes after those that it refers to.
class MaterialOrder {
 public:
  MaterialOrder(const std::vector<Material>& slots, Scene& scene)
      : slots_(slots), scene_(scene), ids_(slots.size(), none) {}

  Id<Material> place(std::uint32_t slot, int depth = 0) {
    const auto refuse = [&](const char* why) {
      throw Error(fmt::format("the mix of materials \"{}\" {}", slots_[slot].name, why),
                  location(scene_, slots_[slot].origin));
    };
    if (ids_[slot] < open) return {ids_[slot]};
    if (ids_[slot] == open) refuse("contains itself");
    if (depth >= most_nested) refuse("is nested too deeply");
    ids_[slot] = open;
    Material material = slots_[slot];
    for_each_reference(material, [&](Id<Material>& id) { id = place(id.value, depth + 1); });
    ids_[slot] = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
    return {ids_[slot]};
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffu, open = 0xfffffffeu;
  const std::vector<Material>& slots_;
  Scene& scene_;
  std::vector<std::uint32_t> ids_;
};

}  // namespace

// Those that waited for textures: all, or those whose textures are known by now.
void Interpreter::resolve_deferred(bool all) {
  std::erase_if(deferred_, [&](DeferredMaterial& deferred) {
    if (!all && !textures_are_known(deferred.parameters, textures_)) return false;
    context_.report.begin_item(deferred.place, RecordKind::material);
    const Scope where{{context_, deferred.color_space}, textures_, scene_.textures, origin(deferred.place)};
    set_material(deferred.slot, made_material(deferred.kind, deferred.parameters, where));
    return true;
  });
  context_.report.begin_item({});
}

void Interpreter::resolve_materials() {
  resolve_deferred(true);
  material_names_.require_definitions();
  for (const auto& [slot, name] : named_slots_) materials_[slot].name = name;
  if (is_in_order(materials_)) {
    scene_.materials = std::move(materials_);
    return;
  }
  MaterialOrder order(materials_, scene_);
  for (std::uint32_t slot = 0; slot < materials_.size(); ++slot) order.place(slot);
  const auto renumber = [&](Shape& shape) { shape.material = order.place(shape.material.value); };
  for (Shape& shape : scene_.shapes) renumber(shape);
  for (Prototype& prototype : scene_.prototypes)
    for (Shape& shape : prototype.shapes) renumber(shape);
}

void Interpreter::resolve_media() {
  medium_names_.require_definitions();
  for (std::optional<Medium>& medium : media_) scene_.media.push_back(std::move(*medium));
}

// Without a surface there is nothing to emit; pbrt leaves such lights out.
void Interpreter::drop_lights_of_interfaces() {
  for (Shape& shape : scene_.shapes)
    if (shape.area_light &&
        std::holds_alternative<InterfaceMaterial>(scene_.materials[shape.material.value].model)) {
      const Place& place = area_light_places_[shape.area_light->value];
      context_.report.begin_item(place, RecordKind::area_light);
      context_.report.dropped("an area light on the material \"interface\" does not shine, as in pbrt",
                              place);
      shape.area_light.reset();
    }
}

void Interpreter::resolve_instances() {
  object_names_.require_definitions();
  const auto is_empty = [&](const Instance& instance) {
    const Prototype& prototype = scene_.prototypes[instance.prototype.value];
    return prototype.shapes.empty() && prototype.instances.empty();
  };
  for (Prototype& prototype : scene_.prototypes) std::erase_if(prototype.instances, is_empty);
  std::erase_if(scene_.instances, is_empty);
}

}  // namespace vitrail::pbrt
