// SPDX-License-Identifier: Apache-2.0
#include "scene/records/uv_uses.h"

#include <algorithm>

namespace vitrail {

namespace {

// Visits the parameters of a record, and asks of each whether (u,v) show in it.
struct Search {
  UvUses& uses;
  bool found = false;

  void any(const auto&... fields) { (one(fields), ...); }

  void one(const FloatParameter& p) { found = found || uses.of(p); }
  void one(const SpectrumParameter& p) { found = found || uses.of(p); }
  template <class T>
  void one(const std::optional<T>& p) {
    if (p) one(*p);
  }
  void one(const Roughness& r) {
    found = found || r.alpha_u != r.alpha_v;
    any(r.alpha_u, r.alpha_v);
  }
  void one(const CoatingVolume& v) { any(v.thickness, v.g, v.albedo); }
  void one(const Metal& metal) {
    if (const auto* index = std::get_if<ComplexIndex>(&metal)) any(index->eta, index->k);
    if (const auto* normal = std::get_if<NormalReflectance>(&metal)) one(normal->reflectance);
  }
  void one(const TextureMapping& m) { found = found || std::holds_alternative<UvMapping>(m); }

  void operator()(const DiffuseMaterial& m) { any(m.reflectance, m.sigma_deg); }
  void operator()(const DielectricMaterial& m) {
    any(m.roughness, m.reflectance_factor, m.transmittance_factor);
  }
  void operator()(const ThinDielectricMaterial& m) { any(m.reflectance_factor, m.transmittance_factor); }
  void operator()(const ConductorMaterial& m) { any(m.metal, m.roughness, m.reflectance_factor); }
  void operator()(const PlasticMaterial& m) {
    any(m.diffuse_reflectance, m.specular_reflectance, m.roughness);
  }
  void operator()(const CoatedDiffuseMaterial& m) { any(m.reflectance, m.roughness, m.volume); }
  void operator()(const CoatedConductorMaterial& m) {
    any(m.metal, m.conductor_roughness, m.interface_roughness, m.volume);
  }
  void operator()(const DiffuseTransmissionMaterial& m) { any(m.reflectance, m.transmittance); }
  void operator()(const PrincipledMaterial& m) {
    found = found || m.anisotropic != FloatParameter{0.0f};
    any(m.base_color, m.roughness, m.metallic, m.spec_trans, m.spec_tint, m.sheen, m.sheen_tint, m.flatness,
        m.clearcoat, m.clearcoat_gloss, m.diff_trans);
  }
  void operator()(const SubsurfaceMaterial& m) {
    one(m.roughness);
    if (const auto* c = std::get_if<SubsurfaceMaterial::Coefficients>(&m.interior))
      any(c->sigma_a, c->sigma_s);
    if (const auto* e = std::get_if<SubsurfaceMaterial::Effective>(&m.interior))
      any(e->reflectance, e->mean_free_path);
  }
  void operator()(const HairMaterial& m) {
    found = found || !uses.on_curves;  // runs along u or v
    any(m.sigma_a, m.color, m.eumelanin, m.pheomelanin, m.beta_m, m.beta_n, m.alpha_deg);
  }
  void operator()(const MeasuredMaterial&) {}
  void operator()(const TabulatedMaterial& m) {
    found = found || m.format == TabulatedMaterial::Format::adaptive;  // may be anisotropic
  }
  void operator()(const SlabMaterial& m) { any(m.sigma_a, m.sigma_s); }
  void operator()(const InterfaceMaterial&) {}
  void operator()(const BlendMaterial& m) { one(m.amount); }
  void operator()(const MaskMaterial& m) { one(m.opacity); }
  void operator()(const TwoSidedMaterial&) {}

  void operator()(const ImageTexture& t) { one(t.mapping); }
  void operator()(const CheckerboardTexture& t) {
    if (!t.solid) one(t.mapping);
    any(t.even, t.odd);
  }
  void operator()(const ProductTexture& t) { any(t.first, t.second); }
  void operator()(const MixTexture& t) { any(t.first, t.second, t.amount); }
  void operator()(const DirectionMixTexture& t) { any(t.first, t.second); }
  void operator()(const BilinearTexture& t) {
    one(t.mapping);
    any(t.v00, t.v01, t.v10, t.v11);
  }
  void operator()(const DotsTexture& t) {
    one(t.mapping);
    any(t.inside, t.outside);
  }
  void operator()(const NoiseTexture&) {}
  void operator()(const PtexTexture&) { found = true; }
  void operator()(const MeshAttributeTexture&) {}
  void operator()(const UvTexture& t) { one(t.mapping); }
};

}  // namespace

bool UvUses::of(Id<Texture> texture) {
  while (known_.size() <= texture.value) {
    Search search{*this};
    std::visit(search, static_cast<const TextureVariant&>(textures_.at(known_.size()).model));
    known_.push_back(search.found);
  }
  return known_[texture.value];
}

bool UvUses::of(const FloatParameter& parameter) {
  const auto* id = std::get_if<Id<Texture>>(&parameter);
  return id && of(*id);
}

bool UvUses::of(const SpectrumParameter& parameter) {
  const auto* id = std::get_if<Id<Texture>>(&parameter);
  return id && of(*id);
}

bool UvUses::of(const Material& material) {
  if (material.normal_map || (material.displacement && of(*material.displacement))) return true;
  Search search{*this};
  std::visit(search, static_cast<const MaterialVariant&>(material.model));
  return search.found;
}

std::vector<Id<Material>> parts_of(const MaterialModel& model) {
  if (const auto* m = std::get_if<BlendMaterial>(&model)) return {m->first, m->second};
  if (const auto* m = std::get_if<MaskMaterial>(&model)) return {m->material};
  if (const auto* m = std::get_if<TwoSidedMaterial>(&model)) return {m->front, m->back};
  return {};
}

std::vector<bool> with_hair(const std::vector<Material>& materials, bool also_along_v) {
  std::vector<bool> result;
  for (const Material& material : materials) {
    const auto* hair = std::get_if<HairMaterial>(&material.model);
    const auto is_with = [&](Id<Material> part) { return result.at(part.value); };
    result.push_back((hair && (also_along_v || !hair->along_v)) ||
                     std::ranges::any_of(parts_of(material.model), is_with));
  }
  return result;
}

ShapeUvUses::ShapeUvUses(const Scene& scene, bool on_curves)
    : scene_(scene), uses_(scene.textures, on_curves), materials_(scene.materials.size(), Shows::unknown) {}

bool ShapeUvUses::of(std::uint32_t id) {
  if (materials_[id] == Shows::unknown) {
    materials_[id] = Shows::no;  // while it is being asked
    bool shows = uses_.of(scene_.materials[id]);
    for (const Id<Material> part : parts_of(scene_.materials[id].model)) shows = of(part.value) || shows;
    materials_[id] = shows ? Shows::yes : Shows::no;
  }
  return materials_[id] == Shows::yes;
}

bool ShapeUvUses::of(const Shape& shape) {
  return scene_.film.layers.has(Layer::uv) || of(shape.material.value) || uses_.of(shape.opacity) ||
         (shape.area_light && uses_.of(scene_.area_lights[shape.area_light->value].radiance));
}

std::vector<bool> meshes_whose_uvs_show(const Scene& scene) {
  if (scene.film.layers.has(Layer::uv)) return std::vector<bool>(scene.meshes.size(), true);
  ShapeUvUses uses(scene);
  std::vector<bool> meshes(scene.meshes.size());
  const auto note = [&](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes)
      if (uses.of(shape)) meshes[shape.mesh.value] = true;
  };
  note(scene.shapes);
  for (const Prototype& prototype : scene.prototypes) note(prototype.shapes);
  return meshes;
}

}  // namespace vitrail
