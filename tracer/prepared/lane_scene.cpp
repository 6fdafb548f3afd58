// SPDX-License-Identifier: Apache-2.0
#include "tracer/prepared/lane_scene.h"

#include <algorithm>
#include <variant>

#include "scene/records/material_traits.h"
#include "tracer/bsdf/principled_lobes.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

namespace {

bool is_one(const SpectrumParameter& p) { return p == SpectrumParameter{Spectrum{ConstantSpectrum{1}}}; }
bool is_constant(const SpectrumParameter& p) { return std::holds_alternative<Spectrum>(p); }

// Those of LaneBsdf, in its order.
void set_spectra(std::initializer_list<const SpectrumParameter*> parameters, LaneMaterial& s) {
  s.is_textured = s.has_parameters = !std::ranges::all_of(
      parameters, is_constant, [](const auto* p) -> const auto& { return *p; });
  if (s.is_textured) return;
  FlatSpectrum* next = s.spectra;
  for (const SpectrumParameter* p : parameters) *next++ = flat_spectrum(std::get<Spectrum>(*p));
}

// Null where the widths are textured: they may be smooth in places.
const float* width_of(const Roughness& r) {
  return std::holds_alternative<float>(r.alpha_v) ? std::get_if<float>(&r.alpha_u) : nullptr;
}

void set(const DiffuseMaterial& m, LaneMaterial& s) {
  if (m.sigma_deg != FloatParameter{0.0f}) return;
  s.kind = LaneKind::diffuse;
  set_spectra({&m.reflectance}, s);
}

void set(const ConductorMaterial& m, LaneMaterial& s) {
  if (!width_of(m.roughness)) return;
  s.kind = is_smooth(m.roughness) ? LaneKind::mirror : LaneKind::metal;
  static const SpectrumParameter nothing = Spectrum{ConstantSpectrum{0}};
  const auto* index = std::get_if<ComplexIndex>(&m.metal);
  set_spectra({index ? &index->eta : &nothing, index ? &index->k : &nothing, &m.reflectance_factor}, s);
  if (const auto* normal = std::get_if<NormalReflectance>(&m.metal)) {
    s.is_textured = s.is_textured || !is_constant(normal->reflectance);
    s.has_parameters = true;
  }
}

void set(const PlasticMaterial& m, LaneMaterial& s) {
  if (!width_of(m.roughness)) return;
  s.kind = m.roughness.alpha_u == FloatParameter{0.0f} ? LaneKind::plastic : LaneKind::rough_plastic;
  set_spectra({&m.diffuse_reflectance, &m.specular_reflectance}, s);
}

void set(const PrincipledMaterial& m, LaneMaterial& s) {
  if (m.thin) return;
  s.kind = LaneKind::principled;
  const FloatParameter* const numbers[] = {&m.roughness, &m.anisotropic,    &m.metallic,   &m.spec_trans,
                                           &m.spec_tint, &m.sheen,          &m.sheen_tint, &m.flatness,
                                           &m.clearcoat, &m.clearcoat_gloss};
  set_spectra({&m.base_color}, s);
  if (std::ranges::all_of(numbers, [](const auto* number) { return std::holds_alternative<float>(*number); }))
    return;
  s.is_textured = s.has_parameters = true;
}

void set(const FinishMaterial& m, LaneMaterial& s) {
  s.kind = LaneKind::finish;
  set_spectra({&m.reflectance, &m.highlight}, s);
}

bool is_textured(const Roughness& r) { return !width_of(r) || !std::holds_alternative<float>(r.alpha_v); }
bool is_textured(const CoatingVolume& v) {
  return !std::holds_alternative<float>(v.thickness) || !std::holds_alternative<float>(v.g) ||
         !is_constant(v.albedo);
}

// Parameters are for each path, as its walks have an event of their own.
void set(const CoatedDiffuseMaterial& m, LaneMaterial& s) {
  s.kind = LaneKind::coated_diffuse;
  s.is_textured = !is_constant(m.reflectance) || is_textured(m.roughness) || is_textured(m.volume);
}

void set(const CoatedConductorMaterial& m, LaneMaterial& s) {
  s.kind = LaneKind::coated_conductor;
  const auto* index = std::get_if<ComplexIndex>(&m.metal);
  const auto* normal = std::get_if<NormalReflectance>(&m.metal);
  s.is_textured = (index && (!is_constant(index->eta) || !is_constant(index->k))) ||
                  (normal && !is_constant(normal->reflectance)) || is_textured(m.conductor_roughness) ||
                  is_textured(m.interface_roughness) || is_textured(m.volume);
}

void set(const DielectricMaterial& m, LaneMaterial& s) {
  const auto *behind = std::get_if<ConstantSpectrum>(&m.eta),
             *before = std::get_if<ConstantSpectrum>(&m.exterior_eta);
  if (!behind || !before || m.priority) return;
  if (!is_smooth(m.roughness)) {
    const float eta = before->value > 0 ? behind->value / before->value : behind->value;
    if (!width_of(m.roughness) || goes_straight(static_cast<double>(eta))) return;
    s.kind = LaneKind::rough_glass;
    return set_spectra({&m.reflectance_factor, &m.transmittance_factor}, s);
  }
  s.kind = LaneKind::glass;
  s.is_tinted = !is_one(m.reflectance_factor) || !is_one(m.transmittance_factor);
  set_spectra({&m.reflectance_factor, &m.transmittance_factor}, s);
  s.eta_behind = behind->value, s.eta_before = before->value;
}

void set(const ThinDielectricMaterial& m, LaneMaterial& s) {
  const auto *sheet = std::get_if<ConstantSpectrum>(&m.eta),
             *around = std::get_if<ConstantSpectrum>(&m.exterior_eta);
  if (!sheet || !around) return;
  s.kind = LaneKind::sheet;
  set_spectra({&m.reflectance_factor, &m.transmittance_factor}, s);
  s.eta_behind = around->value > 0 ? sheet->value / around->value : sheet->value;
}

// What is nothing but an image.
LaneTexture lane_texture(const Manifest& manifest, const Textures& images,
                         const SpectrumParameter& reflectance) {
  const auto* id = std::get_if<Id<Texture>>(&reflectance);
  const auto* image = id ? std::get_if<ImageTexture>(&manifest.textures[id->value].model) : nullptr;
  const auto* mapping = image ? std::get_if<UvMapping>(&image->mapping) : nullptr;
  if (!mapping || image->filter != TextureFilter::bilinear) return {};
  return {&images.image(*id), id->value, *mapping, image->wrap};
}

LaneMaterial lane_material(const Manifest& manifest, const Textures& images, const Material& material) {
  LaneMaterial s;
  s.two_sided = material.two_sided;
  s.along_surface = has_direction(material.model, manifest.tables);
  if (material.bump_shadowing) return s;
  if (const auto* diffuse = std::get_if<DiffuseMaterial>(&material.model)) {
    set(*diffuse, s);
    if (s.kind == LaneKind::diffuse) s.texture = lane_texture(manifest, images, diffuse->reflectance);
    if (s.texture.image) s.is_textured = s.has_parameters = false;
  }
  if (const auto* metal = std::get_if<ConductorMaterial>(&material.model)) set(*metal, s);
  if (const auto* plastic = std::get_if<PlasticMaterial>(&material.model)) set(*plastic, s);
  if (const auto* principled = std::get_if<PrincipledMaterial>(&material.model)) set(*principled, s);
  if (const auto* finish = std::get_if<FinishMaterial>(&material.model)) set(*finish, s);
  if (const auto* coated = std::get_if<CoatedDiffuseMaterial>(&material.model)) set(*coated, s);
  if (const auto* coated = std::get_if<CoatedConductorMaterial>(&material.model)) set(*coated, s);
  if (const auto* glass = std::get_if<DielectricMaterial>(&material.model)) set(*glass, s);
  if (const auto* sheet = std::get_if<ThinDielectricMaterial>(&material.model)) set(*sheet, s);
  s.is_raised = material.displacement.has_value();
  s.is_tilted = s.is_raised || material.normal_map;
  if (s.is_tilted && s.kind == LaneKind::glass) s.kind = LaneKind::none;
  return s;
}

// Glass that is chosen by chance is no interface: connections do not look through it.
bool may_choose_for_lanes(const Manifest& manifest, const std::vector<LaneMaterial>& materials,
                          std::uint32_t material) {
  const std::vector<Id<Material>> parts = parts_of(manifest.materials[material].model);
  if (parts.empty()) {
    const LaneKind kind = materials[material].kind;
    return kind != LaneKind::none && kind != LaneKind::glass;
  }
  return std::ranges::any_of(
      parts, [&](Id<Material> id) { return may_choose_for_lanes(manifest, materials, id.value); });
}

LaneSurface lane_surface(const Manifest& manifest, const std::vector<LaneMaterial>& lanes,
                         const Interiors& interiors, const Materials& materials, const Surface& surface) {
  LaneSurface s;
  s.emits = surface.area_light >= 0;
  const MaterialKind& kind = materials.kind(surface.material);
  if (surface.opacity != FloatParameter{1.0f} || interiors.has_priority(surface)) return s;
  s.blocks = kind.opaque;
  if (kind.is_interface || kind.is_fibre) return s;
  s.is_chosen = is_made_of_others(manifest.materials[surface.material]);
  s.is_for_lanes = s.is_chosen ? may_choose_for_lanes(manifest, lanes, surface.material)
                               : lanes[surface.material].kind != LaneKind::none;
  return s;
}

LaneLamp lane_lamp(const LightSampler& lights, std::size_t number) {
  if (const LightRef light = lights.light_of(number); light.kind == LightKind::emitter)
    return lights.emitters[light.index].shape->plain() ? LaneLamp::emitter : LaneLamp::other;
  const LightSampler::Slot& slot = lights.slots[number];
  const bool is_quadric = slot.light.kind == LightKind::quadric;
  if (!is_quadric && slot.light.kind != LightKind::triangle) return LaneLamp::other;
  const AreaLight& light = lights.scene.area_lights[slot.area_light];
  if (light.directional || !std::holds_alternative<Spectrum>(light.radiance)) return LaneLamp::other;
  if (slot.opacity != FloatParameter{1.0f}) return LaneLamp::other;
  if (is_quadric) {
    const Quadric& quadric = lights.quadrics[slot.light.index].record().quadric.quadric;
    return is_whole_sphere(quadric) ? LaneLamp::sphere : LaneLamp::other;
  }
  return lights.parts_of_triangle(slot.light.index) ? LaneLamp::other : LaneLamp::triangle;
}

}  // namespace

LaneBsdf lane_bsdf(const Bsdf& bsdf) {
  LaneBsdf l;
  if (const auto* lambert = std::get_if<LambertBsdf>(&bsdf)) {
    l.spectra[0] = lambert->reflectance;
  } else if (const auto* metal = std::get_if<ConductorBsdf>(&bsdf)) {
    l.spectra[0] = metal->eta, l.spectra[1] = metal->k, l.spectra[2] = metal->factor;
    l.microfacets = metal->microfacets;
    l.is_perfect = metal->perfect;
  } else if (const auto* plastic = std::get_if<PlasticBsdf>(&bsdf)) {
    l.spectra[0] = plastic->diffuse_reflectance, l.spectra[1] = plastic->specular_reflectance;
    l.eta = plastic->eta, l.internal_reflectance = plastic->internal_reflectance;
    l.is_nonlinear = plastic->nonlinear;
  } else if (const auto* rough = std::get_if<RoughPlasticBsdf>(&bsdf)) {
    l.spectra[0] = rough->diffuse_reflectance, l.spectra[1] = rough->specular_reflectance;
    l.eta = rough->eta, l.internal_reflectance = rough->tables->internal_reflectance;
    l.microfacets = rough->microfacets;
    l.external_transmittance = rough->tables->external_transmittance.data();
    l.is_nonlinear = rough->nonlinear;
  } else if (const auto* p = std::get_if<PrincipledBsdf>(&bsdf)) {
    l.spectra[0] = p->base_color;
    l.microfacets = principled::microfacets(p->roughness, p->anisotropic);
    l.principled = *p;
  } else if (const auto* finish = std::get_if<FinishBsdf>(&bsdf)) {
    l.spectra[0] = finish->reflectance, l.spectra[1] = finish->highlight;
    l.finish = *finish;
  } else if (const auto* diffuse = std::get_if<CoatedDiffuseBsdf>(&bsdf)) {
    l.spectra[0] = diffuse->reflectance;
  } else if (const auto* coated = std::get_if<CoatedConductorBsdf>(&bsdf)) {
    l.spectra[0] = coated->eta, l.spectra[1] = coated->k;
    l.microfacets = coated->conductor;
  } else if (const auto* glass = std::get_if<DielectricBsdf>(&bsdf)) {
    l.spectra[0] = glass->reflectance_factor, l.spectra[1] = glass->transmittance_factor;
    l.eta = glass->eta;
    l.microfacets = glass->microfacets;
  } else if (const auto* sheet = std::get_if<ThinDielectricBsdf>(&bsdf)) {
    l.spectra[0] = sheet->reflectance_factor, l.spectra[1] = sheet->transmittance_factor;
  }
  return l;
}

LaneCoating lane_coating(const Bsdf& bsdf, std::uint64_t event) {
  if (const auto* diffuse = std::get_if<CoatedDiffuseBsdf>(&bsdf))
    return {diffuse->eta, diffuse->interface, bounded(diffuse->volume), event};
  const auto& metal = std::get<CoatedConductorBsdf>(bsdf);
  return {metal.interface_eta, metal.interface, bounded(metal.volume), event};
}

LaneScene::LaneScene(const Manifest& manifest, const Textures& images, const Interiors& interiors,
                     const Materials& all_materials, const LightSampler& lights) {
  const Requirements& r = manifest.requirements;
  passes_light = r.see_through || r.media || (r.refraction && manifest.settings.direct_only);
  has_walks = all_materials.have_panes() && !manifest.settings.direct_only;
  has_connections = passes_light || (has_walks && !lights.distant.empty()) ||
                    !std::ranges::all_of(lights.emitters, &PointEmitter::casts_shadows);
  divides_space = interiors.divide_space();
  for (const Material& material : manifest.materials) {
    LaneMaterial& lane = materials.emplace_back(lane_material(manifest, images, material));
    lane.transmits = all_materials.kind(static_cast<std::uint32_t>(materials.size() - 1)).transmits;
    if (lane.kind != LaneKind::none && lane.kind < LaneKind::glass && !lane.has_parameters &&
        !lane.texture.image)
      lane.constants = lane_bsdf(all_materials.bsdf_at(material, {}, luminance_wavelengths()[0]));
    has_textures = has_textures || lane.texture.image != nullptr;
  }
  for (const Surface& surface : manifest.surfaces)
    surfaces.push_back(lane_surface(manifest, materials, interiors, all_materials, surface));
  for (const AreaLight& light : manifest.area_lights) {
    const auto* spectrum = std::get_if<Spectrum>(&light.radiance);
    radiances.push_back(spectrum ? flat_spectrum(*spectrum, light.scale) : FlatSpectrum{});
  }
  no_emitter = {.shape = std::make_shared<const EmitterShape>()};
  for (const LightSampler::Distant& light : lights.distant)
    distant.push_back({!light.sun, flat_spectrum(light.irradiance)});
  lamps.reserve(lights.tree.order().size());
  for (std::size_t slot = 0; slot < lights.tree.order().size(); ++slot)
    lamps.push_back(lane_lamp(lights, slot));
}

}  // namespace vitrail
