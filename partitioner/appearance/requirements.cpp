// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/requirements.h"

#include "bundle/record_fields.h"

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
  void operator()(const auto&) {}

 private:
  void mapping(const TextureMapping& m) { r.uv |= std::holds_alternative<UvMapping>(m); }
};

bool is_isotropic(const Roughness& r) { return r.alpha_u == r.alpha_v; }
bool is_smooth(const Roughness& r) {
  return r.alpha_u == FloatParameter{0.0f} && r.alpha_v == FloatParameter{0.0f};
}
bool is_zero(const FloatParameter& p) { return p == FloatParameter{0.0f}; }

}  // namespace

bool is_smooth_glass(const Material& material) {
  const auto* glass = std::get_if<DielectricMaterial>(&material.model);
  return glass && is_smooth(glass->roughness);
}

bool is_distant(const Light& light) {
  return std::holds_alternative<DistantLight>(light.model) || std::holds_alternative<SkyLight>(light.model);
}

namespace {

struct MaterialNeeds {
  Requirements& r;
  const std::vector<ScatteringTable>& tables;
  void operator()(const DielectricMaterial& m) {
    r.uv |= !is_isotropic(m.roughness);
    r.refraction |= is_smooth(m.roughness);
    r.dispersion |= !is_constant(m.eta) || !is_constant(m.exterior_eta);
    r.see_through |= m.priority != 0;
  }
  void operator()(const ConductorMaterial& m) { r.uv |= !is_isotropic(m.roughness); }
  void operator()(const CoatedDiffuseMaterial& m) { r.uv |= !is_isotropic(m.roughness); }
  void operator()(const CoatedConductorMaterial& m) {
    r.uv |= !is_isotropic(m.conductor_roughness) || !is_isotropic(m.interface_roughness);
  }
  void operator()(const PrincipledMaterial& m) { r.uv |= !is_zero(m.anisotropic); }
  void operator()(const HairMaterial&) {
    r.uv = r.see_through = true;
  }  // runs along u or v; open from within
  void operator()(const ThinDielectricMaterial&) { r.see_through = true; }
  void operator()(const MeasuredMaterial&) { r.see_through = true; }
  void operator()(const SlabMaterial&) { r.see_through = true; }
  void operator()(const TabulatedMaterial& m) {
    const auto* table = std::get_if<AdaptiveTable>(&tables.at(m.table.value));
    r.uv |= table && !is_isotropic(*table);
  }
  void operator()(const InterfaceMaterial&) { r.see_through = true; }
  void operator()(const MaskMaterial& m) { r.see_through |= m.opacity != FloatParameter{1.0f}; }
  void operator()(const auto&) {}
};

}  // namespace

Requirements requirements_of(const Manifest& m, bool has_normals) {
  Requirements r;
  r.shading_normals = has_normals;
  r.media = !m.media.empty();
  r.uv = m.film.layers.has(Layer::uv);
  const std::vector<bool> used = textures_on_surfaces(m);
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) std::visit(TextureNeeds{r}, m.textures[i].model);
  for (const Material& material : m.materials) {
    std::visit(MaterialNeeds{r, m.tables}, material.model);
    r.uv |= material.displacement || material.normal_map;
  }
  for (const Surface& surface : m.surfaces) r.see_through |= surface.opacity != FloatParameter{1.0f};
  return r;
}

Requirements all_requirements() { return {true, true, true, true, true, true, true}; }

}  // namespace vitrail
