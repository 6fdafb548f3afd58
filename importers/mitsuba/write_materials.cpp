// SPDX-License-Identifier: Apache-2.0
// Each material is an element inside its adapters: twosided ⊃ normalmap ⊃ bumpmap ⊃ model. The outermost has
// the id.
#include "importers/mitsuba/write_materials.h"

namespace vitrail::mitsuba_writer {

namespace {

bool is_zero(const FloatParameter& value) {
  const auto* number = std::get_if<float>(&value);
  return number && *number == 0;
}

const Material& material_of(const Scene& scene, Id<Material> id) { return scene.materials[id.value]; }

// Mitsuba's bare opaque BSDFs are black on their back; those that transmit have both sides anyway.
bool wants_two_sided(const Context& context, const Material& material) {
  return material.two_sided && !std::holds_alternative<TwoSidedMaterial>(material.model) &&
         !transmits(context.scene, material);
}

void write_material(Context& context, Element parent, const Material& material, std::string id) {
  const auto wrap = [&](const char* type) {
    parent = add(parent, "bsdf", type, "", id);
    id.clear();
  };
  if (wants_two_sided(context, material)) wrap("twosided");
  if (material.normal_map) {
    const WrittenTexture& texture = context.textures[material.normal_map->value];
    if (const auto* reference = std::get_if<std::string>(&texture)) {
      wrap("normalmap");
      add_reference(parent, *reference, "normalmap");
    } else {
      context.dropped("the normal map: Mitsuba takes an image");
    }
  }
  if (material.displacement && !value_of(context, *material.displacement)) {
    wrap("bumpmap");
    add_float(parent, "scale", 1.0);
    add_parameter(context, parent, "texture", *material.displacement);
  }
  write_model(context, parent, material, id);
}

}  // namespace

bool transmits(const Scene& scene, const Material& material) {
  return std::visit(Overloaded{
                        [](const DielectricMaterial&) { return true; },
                        [](const ThinDielectricMaterial&) { return true; },
                        [](const DiffuseTransmissionMaterial&) { return true; },
                        [](const PrincipledMaterial& m) { return m.thin || !is_zero(m.spec_trans); },
                        [](const SubsurfaceMaterial&) { return true; },
                        [](const HairMaterial&) { return true; },
                        [](const InterfaceMaterial&) { return true; },
                        [](const MaskMaterial&) { return true; },
                        [&](const BlendMaterial& m) {
                          return transmits(scene, material_of(scene, m.first)) ||
                                 transmits(scene, material_of(scene, m.second));
                        },
                        [&](const TwoSidedMaterial& m) {
                          return transmits(scene, material_of(scene, m.front)) ||
                                 transmits(scene, material_of(scene, m.back));
                        },
                        [](const auto&) { return false; },
                    },
                    material.model);
}

bool has_sides(const Scene& scene, const Material& material) {
  if (std::holds_alternative<InterfaceMaterial>(material.model)) return false;
  if (const auto* mask = std::get_if<MaskMaterial>(&material.model))
    return has_sides(scene, material_of(scene, mask->material));
  if (const auto* blend = std::get_if<BlendMaterial>(&material.model))
    return has_sides(scene, material_of(scene, blend->first)) ||
           has_sides(scene, material_of(scene, blend->second));
  return !material.two_sided || transmits(scene, material) ||
         std::holds_alternative<TwoSidedMaterial>(material.model);
}

void write_materials(Context& context, Element root) {
  for (std::size_t i = 0; i < context.scene.materials.size(); ++i) {
    const Material& material = context.scene.materials[i];
    context.origin = material.origin;
    context.material_ids.push_back(context.new_id(material.name, "material", i));
    write_material(context, root, material, context.material_ids.back());
  }
}

}  // namespace vitrail::mitsuba_writer
