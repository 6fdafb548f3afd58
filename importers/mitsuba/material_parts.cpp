// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/material_parts.h"

#include <algorithm>

#include "scene/shapes/deferred_mesh.h"

namespace vitrail::mitsuba {

namespace {

MaterialParts both(const MaterialParts& a, const MaterialParts& b) {
  return {a.straight || b.straight, a.spread_through || b.spread_through, a.height || b.height,
          a.bumps || b.bumps};
}

// Whether it has a direction along the surface.
bool is_brushed(const Material& material) {
  const auto two = [](const Roughness& r) { return r.alpha_u != r.alpha_v; };
  if (const auto* m = std::get_if<ConductorMaterial>(&material.model)) return two(m->roughness);
  if (const auto* m = std::get_if<DielectricMaterial>(&material.model)) return two(m->roughness);
  const auto* principled = std::get_if<PrincipledMaterial>(&material.model);
  return principled && principled->anisotropic != FloatParameter{0.0f};
}

}  // namespace

std::vector<const char*> bumps_shown_otherwise(const Material& material) {
  std::vector<const char*> sentences;
  if (!material.displacement && !material.normal_map) return sentences;
  if (material.displacement && is_brushed(material))
    sentences.push_back("a bump map on what is brushed: Mitsuba 3.9 brushes it in another direction");
  const MaterialTraits traits = traits_of(material.model);
  if (traits.lobes.smooth)
    sentences.push_back(
        "bumps of a mirror or smooth interface: what they reflect into the surface is black in Mitsuba");
  if (traits.transmits)
    sentences.push_back(
        "bumps of what light goes through: Mitsuba shows no light between the bumped surface and the smooth "
        "one");
  return sentences;
}

bool is_tinted(const PrincipledMaterial& m) {
  const bool sheen = m.sheen_tint != FloatParameter{0.0f} && m.sheen != FloatParameter{0.0f};
  return sheen || m.spec_tint != FloatParameter{0.0f};
}

MaterialParts parts_of(const Material& material, const std::vector<MaterialParts>& others) {
  const auto part = [&](Id<Material> id) { return others.at(id.value); };
  if (const auto* blend = std::get_if<BlendMaterial>(&material.model))
    return both(part(blend->first), part(blend->second));
  if (const auto* sided = std::get_if<TwoSidedMaterial>(&material.model))
    return both(part(sided->front), part(sided->back));
  if (const auto* mask = std::get_if<MaskMaterial>(&material.model))
    return both(part(mask->material), {.straight = true});
  const MaterialTraits traits = traits_of(material.model);
  return {.straight = traits.straight,
          .spread_through = traits.transmits && traits.lobes.spread,
          .height = material.displacement.has_value(),
          .bumps = material.displacement || material.normal_map};
}

std::vector<MaterialParts> parts_of(const std::vector<Material>& materials) {
  std::vector<MaterialParts> result;
  for (const Material& material : materials) result.push_back(parts_of(material, result));
  return result;
}

bool has_read_vertices(const Scene& scene, const TriangleMesh& mesh) {
  TriangleMesh storage;
  return std::ranges::any_of(scene.textures, [&](const Texture& texture) {
    const auto* read = std::get_if<MeshAttributeTexture>(&texture.model);
    if (!read || !read->name.starts_with("vertex_")) return false;
    return std::ranges::any_of(loaded(mesh, storage).attributes,
                               [&](const MeshAttribute& a) { return a.name == read->name; });
  });
}

bool is_darkened(const Material& material, const std::vector<MaterialTraits>& traits,
                 const std::vector<MaterialParts>& parts) {
  const auto* blend = std::get_if<BlendMaterial>(&material.model);
  if (!blend) return false;
  const MaterialParts first = parts.at(blend->first.value), second = parts.at(blend->second.value);
  return blends_mirror_with_spread(material, traits) || (first.straight && second.spread_through) ||
         (first.spread_through && second.straight);
}

}  // namespace vitrail::mitsuba
