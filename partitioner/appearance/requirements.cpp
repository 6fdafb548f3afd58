// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/requirements.h"

#include "bundle/record_fields.h"
#include "scene/records/material_traits.h"

namespace vitrail {

namespace records {

// Collects the textures that records refer to.
struct TextureCollector {
  static constexpr bool reads = false;
  std::vector<bool>& textures;
  void operator()(Number auto) const {}
  void operator()(Id<Texture> id) const { textures.at(id.value) = true; }
  void operator()(Id<Material>) const {}
  void operator()(Id<ScatteringTable>) const {}
  void may_be_infinite(float) const {}
};

}  // namespace records

namespace {

// Textures of materials, opacities and area lights; those of other lights are not looked up on surfaces.
std::vector<bool> textures_on_surfaces(const Manifest& m) {
  std::vector<bool> used(m.textures.size());
  records::TextureCollector collect{used};
  for (const Material& material : m.materials) records::fields(collect, material);
  for (const AreaLight& light : m.area_lights) records::fields(collect, light);
  for (const Surface& surface : m.surfaces) records::fields(collect, surface.opacity);
  for (std::size_t i = used.size(); i-- > 0;)
    if (used[i]) records::fields(collect, m.textures[i]);
  return used;
}

struct TextureNeeds {
  Requirements& r;
  void operator()(const ImageTexture& t) {
    mapping(t.mapping);
    r.filtering |= t.filter == TextureFilter::trilinear || t.filter == TextureFilter::anisotropic;
  }
  void operator()(const CheckerboardTexture& t) {
    if (!t.solid) mapping(t.mapping);
  }
  void operator()(const BilinearTexture& t) { mapping(t.mapping); }
  void operator()(const DotsTexture& t) { mapping(t.mapping); }
  void operator()(const UvTexture& t) { mapping(t.mapping); }
  void operator()(const ProductTexture&) {}
  void operator()(const MixTexture&) {}
  void operator()(const DirectionMixTexture&) {}
  void operator()(const NoiseTexture&) {}
  void operator()(const PatternTexture& t) { r.uv |= t.by_uv; }
  void operator()(const PtexTexture&) {}
  void operator()(const MeshAttributeTexture&) {}

 private:
  void mapping(const TextureMapping& m) { r.uv |= std::holds_alternative<UvMapping>(m); }
};

}  // namespace

bool is_smooth_glass(const Material& material) {
  const auto* glass = std::get_if<DielectricMaterial>(&material.model);
  return glass && is_smooth(glass->roughness);
}

namespace {

// Patterns tilt normals by where a point is, and not by its (u,v).
bool is_bumped_by_uv(const Material& material, const std::vector<Texture>& textures) {
  if (!material.displacement) return false;
  const auto* id = std::get_if<Id<Texture>>(&*material.displacement);
  return !id || !std::holds_alternative<PatternTexture>(textures.at(id->value).model);
}

void add_needs(Requirements& r, const Material& material, const Manifest& m) {
  const MaterialTraits traits = traits_of(material.model);
  const auto* glass = std::get_if<DielectricMaterial>(&material.model);
  const auto* mask = std::get_if<MaskMaterial>(&material.model);
  r.uv |=
      has_direction(material.model, m.tables) || material.normal_map || is_bumped_by_uv(material, m.textures);
  r.refraction |= is_smooth_glass(material);
  r.dispersion |= glass && traits.disperses;
  const bool is_full_mask = mask && mask->opacity == FloatParameter{1.0f};
  r.see_through |= (traits.straight && !is_full_mask) || traits.fibre || (glass && glass->priority != 0) ||
                   !material.casts_shadow;
}

}  // namespace

Requirements requirements_of(const Manifest& m, bool has_normals) {
  Requirements r;
  r.shading_normals = has_normals;
  r.media = !m.media.empty();
  r.uv = m.film.layers.has(Layer::uv);
  const std::vector<bool> used = textures_on_surfaces(m);
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) std::visit(TextureNeeds{r}, m.textures[i].model);
  for (const Material& material : m.materials) add_needs(r, material, m);
  for (const Surface& surface : m.surfaces) r.see_through |= surface.opacity != FloatParameter{1.0f};
  return r;
}

Requirements all_requirements() { return {true, true, true, true, true, true, true}; }

}  // namespace vitrail
