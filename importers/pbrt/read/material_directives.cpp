// SPDX-License-Identifier: Apache-2.0
// The directives of materials, textures and media.
#include <fmt/format.h>

#include "importers/pbrt/read/directives.h"

namespace vitrail::pbrt {

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
  if (slot == next) {
    before_named_[slot] = state_.material;
    new_material_slot();
  }
  state_.material = Id<Material>{slot};
}

// pbrt-v3 goes on with the material that was there before an unknown name; it begins with matte.
void Interpreter::define_unknown_materials() {
  material_names_.define_others([&](const std::string& name, std::uint32_t slot, const Place& place) {
    context_.report.begin_item(place, RecordKind::material);
    context_.report.approximated(
        fmt::format("material \"{}\" is not defined: as in pbrt-v3, the one before it stays", name), place);
    const auto before = before_named_.find(slot);
    const bool is_known = before != before_named_.end() && before->second;
    set_material(slot, is_known ? Material(materials_[before->second->value]) : Material{DiffuseMaterial{}});
  });
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

}  // namespace vitrail::pbrt
