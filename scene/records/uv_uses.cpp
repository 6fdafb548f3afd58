// SPDX-License-Identifier: Apache-2.0
#include "scene/records/uv_uses.h"

#include <algorithm>

#include "scene/records/field_search.h"
#include "scene/records/material_traits.h"

namespace vitrail {

namespace {

// Asks of each field whether (u,v) show in it.
struct Search : FieldSearch<Search> {
  using FieldSearch::in;
  explicit Search(UvUses& u) : uses(u) {}
  UvUses& uses;
  bool found = false;

  void in(const FloatParameter& p) { found = found || uses.of(p); }
  void in(const SpectrumParameter& p) { found = found || uses.of(p); }
  void in(const UvMapping&) { found = true; }
  void in(const PtexTexture&) { found = true; }
  void in(const CheckerboardTexture& t) {
    if (!t.solid) in(t.mapping);
    in(t.even), in(t.odd);
  }
  void in(const PatternTexture& t) {
    found = found || t.by_uv;
    in(t.map);
  }
};

}  // namespace

bool UvUses::of(Id<Texture> texture) {
  while (known_.size() <= texture.value) {
    Search search(*this);
    search.in(static_cast<const TextureVariant&>(textures_.at(known_.size()).model));
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
  const MaterialTraits traits = traits_of(material.model);
  const bool knows_where_it_runs = traits.fibre && on_curves;
  if (traits.along_surface && !knows_where_it_runs) return true;
  Search search(*this);
  search.in(static_cast<const MaterialVariant&>(material.model));
  return search.found;
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
