// SPDX-License-Identifier: Apache-2.0
// Once all is read: names and numbers that were used before their definitions.
#include <fmt/format.h>

#include "importers/pbrt/read/directives.h"
#include "scene/records/nesting_limits.h"

namespace vitrail::pbrt {

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
  if (context_.version == Version::v3) define_unknown_materials();
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
