// SPDX-License-Identifier: Apache-2.0
// Each material is an element inside its adapters: normalmap ⊃ bumpmap ⊃ twosided ⊃ model. The outermost has
// the id. Around bumps, twosided would mirror them on the back instead of turning them over with the normal.
#include "importers/mitsuba/write/write_materials.h"

#include "importers/reading/glazing_material.h"

namespace vitrail::mitsuba_writer {

namespace {

// Mitsuba's bare opaque BSDFs are black on their back; those that transmit have both sides anyway, and those
// that are made of others have theirs.
bool wants_two_sided(const Context& context, std::size_t index) {
  const Material& material = context.scene.materials[index];
  return material.two_sided && !is_made_of_others(material) && !context.traits[index].transmits;
}

// A height that is a texture times a number goes into the map's own scale.
void add_height(Context& context, Element parent, const FloatParameter& height) {
  const auto* id = std::get_if<Id<Texture>>(&height);
  const auto* product = id ? std::get_if<ProductTexture>(&context.scene.textures[id->value].model) : nullptr;
  const auto* texture = product ? std::get_if<Id<Texture>>(&product->first) : nullptr;
  const auto factor = product ? value_of(context, product->second) : std::nullopt;
  if (texture && factor && is_constant(*factor)) {
    add_float(parent, "scale", static_cast<float>(evaluate(*factor, 550)));
    return add_parameter(context, parent, "texture", FloatParameter{*texture});
  }
  add_float(parent, "scale", 1.0);
  add_parameter(context, parent, "texture", height);
}

// Those of nothing do not show, and those of a material that is made of others are theirs.
bool shows_bumps(Context& context, const Material& material) {
  if (std::holds_alternative<InterfaceMaterial>(material.model)) return false;
  if (!is_made_of_others(material)) return true;
  if (material.displacement || material.normal_map)
    context.dropped("bumps of a material that is made of others, which have their own");
  return false;
}

// Mitsuba stops at a parameter that it does not know, but not at a <default> that nothing asks for: so it has
// thin glass there.
void write_glazing(Context& context, Element parent, const std::string& id, const std::string& file) {
  context.approximated("Mitsuba has a sheet of clear glass here: it does not know the glazing");
  add(parent, "bsdf", "thindielectric", "", id);
  Element value = parent.root().child("scene").prepend_child("default");
  value.append_attribute("name") = ("glazing:" + id).c_str();
  value.append_attribute("value") = context.relative(file).c_str();
}

void write_material(Context& context, Element parent, std::size_t index, std::string id) {
  if (const std::string file = glazing_file_of(context.scene.materials, index); !file.empty())
    return write_glazing(context, parent, id, file);
  const Material& material = context.scene.materials[index];
  const auto wrap = [&](const char* type) {
    parent = add(parent, "bsdf", type, "", id);
    id.clear();
  };
  if (mitsuba::is_darkened(material, context.traits, context.parts))
    context.approximated(
        "a blend of a mirror, a smooth interface or nothing with what spreads light to the same side: "
        "Mitsuba 3.9 "
        "makes it darker");
  const bool bumps = shows_bumps(context, material);
  if (bumps)
    for (const char* what : mitsuba::bumps_shown_otherwise(material)) context.approximated(what);
  if (bumps && material.normal_map) {
    const WrittenTexture& texture = context.textures[material.normal_map->value];
    if (const auto* reference = std::get_if<std::string>(&texture)) {
      wrap("normalmap");
      add_reference(parent, *reference, "normalmap");
      if (!material.bump_shadowing) add_boolean(parent, "use_shadowing_function", false);
    } else {
      context.dropped("the normal map: Mitsuba takes an image");
    }
  }
  if (bumps && material.displacement && !value_of(context, *material.displacement)) {
    wrap("bumpmap");
    if (!material.bump_shadowing) add_boolean(parent, "use_shadowing_function", false);
    add_height(context, parent, *material.displacement);
  }
  if (wants_two_sided(context, index)) wrap("twosided");
  write_model(context, parent, material, id);
}

}  // namespace

void write_materials(Context& context, Element root) {
  const std::vector<bool> sides = sides_of_glazing(context.scene);
  for (std::size_t i = 0; i < context.scene.materials.size(); ++i) {
    const Material& material = context.scene.materials[i];
    if (sides[i]) {
      context.material_ids.emplace_back();
      continue;
    }
    context.begin(RecordKind::material, material.origin);
    context.material_ids.push_back(context.new_id(material.name, "material", i));
    write_material(context, root, i, context.material_ids.back());
  }
}

}  // namespace vitrail::mitsuba_writer
