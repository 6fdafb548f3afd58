// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/material_uses.h"

#include <algorithm>
#include <set>

#include "importers/povray/write/write_materials.h"
#include "importers/povray/write/write_pigments.h"
#include "scene/records/material_traits.h"

namespace vitrail::povray {

namespace {

void collect(const Scene& scene, Id<Material> material, std::set<std::uint32_t>& found) {
  if (!found.insert(material.value).second) return;
  for (const Id<Material> child : vitrail::parts_of(scene.materials.at(material.value).model))
    collect(scene, child, found);
}

// Those of the parameters that this writer looks up.
template <class... Parameters>
std::vector<Id<Texture>> textures_among(const Parameters&... parameters) {
  std::vector<Id<Texture>> ids;
  const auto add = [&](const auto& parameter) {
    if (const auto* id = std::get_if<Id<Texture>>(&parameter)) ids.push_back(*id);
  };
  (add(parameters), ...);
  return ids;
}

std::vector<Id<Texture>> textures_of(const MaterialModel& model) {
  if (const auto* m = std::get_if<DiffuseMaterial>(&model)) return textures_among(m->reflectance);
  if (const auto* m = std::get_if<PlasticMaterial>(&model)) return textures_among(m->diffuse_reflectance);
  if (const auto* m = std::get_if<CoatedDiffuseMaterial>(&model)) return textures_among(m->reflectance);
  if (const auto* m = std::get_if<PrincipledMaterial>(&model))
    return textures_among(m->base_color, m->spec_trans, m->metallic);
  if (const auto* m = std::get_if<DiffuseTransmissionMaterial>(&model)) return textures_among(m->reflectance);
  if (const auto* m = std::get_if<BlendMaterial>(&model)) return textures_among(m->amount);
  if (const auto* m = std::get_if<MaskMaterial>(&model)) return textures_among(m->opacity);
  if (const auto* m = std::get_if<HairMaterial>(&model))
    return m->color ? textures_among(*m->color) : std::vector<Id<Texture>>{};
  if (const auto* m = std::get_if<SubsurfaceMaterial>(&model)) {
    const auto* effective = std::get_if<SubsurfaceMaterial::Effective>(&m->interior);
    return effective ? textures_among(effective->reflectance) : std::vector<Id<Texture>>{};
  }
  if (const auto* m = std::get_if<ConductorMaterial>(&model)) {
    const auto* normal = std::get_if<NormalReflectance>(&m->metal);
    return normal ? textures_among(normal->reflectance) : std::vector<Id<Texture>>{};
  }
  return {};
}

}  // namespace

std::vector<Id<Material>> parts_of(const Scene& scene, Id<Material> material) {
  std::set<std::uint32_t> found;
  collect(scene, material, found);
  std::vector<Id<Material>> ids;
  for (const std::uint32_t value : found) ids.push_back({value});
  return ids;
}

Caustics caustics_of(const Scene& scene, Id<Material> material) {
  // What rough metals throw on is faint: without it the floors around them are nearer (measured).
  const auto is_smooth = [](const Roughness& roughness) {
    const auto* alpha = std::get_if<float>(&roughness.alpha_u);
    return alpha && *alpha < smooth_alpha && roughness.alpha_v == roughness.alpha_u;
  };
  Caustics caustics;
  for (const Id<Material> part : parts_of(scene, material)) {
    const MaterialModel& model = scene.materials[part.value].model;
    const auto* principled = std::get_if<PrincipledMaterial>(&model);
    const auto* metal = std::get_if<ConductorMaterial>(&model);
    const auto* coated = std::get_if<CoatedConductorMaterial>(&model);
    caustics.refracted |= std::holds_alternative<DielectricMaterial>(model) ||
                          (principled && principled->spec_trans != FloatParameter{0.0f});
    caustics.reflected |= caustics.refracted || (metal && is_smooth(metal->roughness)) ||
                          (coated && is_smooth(coated->conductor_roughness));
  }
  return caustics;
}

std::vector<Id<Texture>> textures_of(const Material& material) {
  std::vector<Id<Texture>> ids = textures_of(material.model);
  if (material.displacement)
    if (const auto* id = std::get_if<Id<Texture>>(&*material.displacement)) ids.push_back(*id);
  return ids;
}

bool uses_uvs(const Scene& scene, Id<Material> material) {
  return std::ranges::any_of(parts_of(scene, material), [&](Id<Material> part) {
    return std::ranges::any_of(textures_of(scene.materials[part.value]),
                               [&](Id<Texture> id) { return uses_uvs(scene, id); });
  });
}

bool is_invisible(const Scene& scene, Id<Material> material) {
  return std::holds_alternative<InterfaceMaterial>(scene.materials.at(material.value).model);
}

}  // namespace vitrail::povray
