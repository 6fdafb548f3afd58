// SPDX-License-Identifier: Apache-2.0
#include "tracer/surfaces/surface_materials.h"

#include <algorithm>
#include <map>

#include "scene/geometry/portable_math.h"
#include "scene/models/pattern_normal.h"
#include "scene/records/material_traits.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/local.h"
#include "tracer/sampling/wavelengths.h"
#include "tracer/surfaces/bsdf_of.h"

namespace vitrail {

namespace {

// Of a fibre there is nothing from behind.
bool is_nothing(const Material& m, bool front) {
  return std::holds_alternative<InterfaceMaterial>(m.model) ||
         (std::holds_alternative<HairMaterial>(m.model) && !front);
}

// What a material, or a part of it, does with light on the way of a connection.
struct Straight {
  bool passes = false, mirrors = false;
};
// `others`: of the materials that it refers to, which come before it.
Straight straight_of(const std::vector<Straight>& others, const Material& material) {
  const auto part = [&](Id<Material> id) { return others[id.value]; };
  if (const auto* sided = std::get_if<TwoSidedMaterial>(&material.model)) {
    const Straight front = part(sided->front), back = part(sided->back);
    return {front.passes && back.passes, front.mirrors && back.mirrors};
  }
  const MaterialTraits traits = traits_of(material.model);
  Straight straight{traits.straight, traits.mirrors};
  for (const Id<Material> id : parts_of(material.model)) {
    straight.passes = straight.passes || part(id).passes;
    straight.mirrors = straight.mirrors || part(id).mirrors;
  }
  return straight;
}

// Whether none of it goes straight on, or through a smooth face; `casts_shadow` is not asked.
bool stops_light(const std::vector<Material>& materials, std::size_t i) {
  const std::vector<Id<Material>> parts = parts_of(materials[i].model);
  const MaterialTraits traits = traits_of(materials[i].model);
  const auto* glass = std::get_if<DielectricMaterial>(&materials[i].model);
  return !traits.straight && !traits.fibre && !(glass && is_smooth(glass->roughness)) &&
         std::ranges::all_of(parts, [&](Id<Material> id) { return stops_light(materials, id.value); });
}

// n + ∇h: the normal of a surface that is raised by a height h(u,v) along n (Blinn 1978).
Vector3d bumped(const FloatParameter& height, const Interaction& at, Vector3d n, const Textures& textures) {
  constexpr double step = 1.0 / 4096;  // in u and v
  TexturePoint point = at.texture_point();
  const double here = textures.number(height, point);
  const auto slope = [&](double du, double dv) {
    TexturePoint moved = point;
    moved.uv = {point.uv.x + du, point.uv.y + dv};
    moved.p = point.p + at.dpdu * du + at.dpdv * dv;
    return (textures.number(height, moved) - here) / step;
  };
  const auto along_surface = [&](Vector3d d) { return d - n * dot(n, d); };
  const Vector3d u = along_surface(at.dpdu) + n * slope(step, 0),
                 v = along_surface(at.dpdv) + n * slope(0, step);
  const Vector3d turned = normalize(cross(u, v));
  return dot(turned, n) < 0 ? -turned : turned;
}

Vector3d mapped(Id<Texture> map, const Interaction& at, Vector3d n, const Textures& textures) {
  const std::array<double, 3> c = textures.vector(map, at.texture_point());
  const Vector3d local = normalize(Vector3d{2 * c[0] - 1, 2 * c[1] - 1, 2 * c[2] - 1});
  const Vector3d tangent = normalize(at.dpdu - n * dot(n, at.dpdu));
  return normalize(tangent * local.x + cross(n, tangent) * local.y + n * local.z);
}

// The pattern that is its displacement: it tilts normals as POV-Ray's `normal` does.
const PatternTexture* bumps_of(const Material& material, const Manifest& manifest) {
  const FloatParameter* const height = material.displacement ? &*material.displacement : nullptr;
  const auto* const id = std::get_if<Id<Texture>>(height);
  return id ? std::get_if<PatternTexture>(&manifest.textures[id->value].model) : nullptr;
}

// v of scene/models/pattern_normal.h.
Vector3d push_of(const PatternTexture& pattern, const FloatParameter& height, const TexturePoint& at,
                 const Textures& textures) {
  const Point3d p = transform_point(inverse(pattern.texture_to_world), at.p);
  if (!pushes_by_itself(pattern.kind))
    return descent_of_height(p, [&](Point3d q) {
      TexturePoint moved = at;
      moved.p = transform_point(pattern.texture_to_world, q);
      return textures.number(height, moved);
    });
  if (pattern.map.empty()) return {};
  const SpectrumParameter& last = pattern.map.back().value;
  const auto* constant = std::get_if<Spectrum>(&last);
  const double most = constant ? evaluate(*constant, 550) : textures.number(std::get<Id<Texture>>(last), at);
  return push_of_pattern(pattern, p) * (most / bump_height);
}

// The normal as maps, heights and patterns turn it, whichever side the ray sees of it.
Vector3d tilted(const Material& material, const Interaction& at, const Manifest& manifest,
                const Textures& textures) {
  Vector3d n = at.shading;
  const PatternTexture* const pattern = bumps_of(material, manifest);
  if (dot(at.dpdu, at.dpdu) > 0) {
    if (material.normal_map) n = mapped(*material.normal_map, at, n, textures);
    if (material.displacement && !pattern) n = bumped(*material.displacement, at, n, textures);
  }
  if (!pattern) return n;
  // The side of the surface that the ray sees is tilted.
  const Vector3d push = push_of(*pattern, *material.displacement, at.texture_point(), textures);
  const Vector3d turned = tilted_normal(*pattern, n * at.side(), push) * at.side();
  return dot(turned, turned) > 0 ? normalize(turned) : n;
}

RoughPlasticTables plastic_tables(double eta, const Microfacets& facets) {
  if (!facets.smooth()) return make_rough_plastic_tables(eta, facets);
  RoughPlasticTables smooth;
  smooth.internal_reflectance = fresnel_diffuse(1 / eta);
  return smooth;
}

}  // namespace

ShadingFrame frame_around(Vector3d n, Vector3d along, double side) {
  ShadingFrame frame;
  frame.tangent = along - n * dot(n, along);
  if (dot(frame.tangent, frame.tangent) > 1e-12 * dot(along, along)) {
    frame.tangent = normalize(frame.tangent);
    frame.bitangent = cross(n, frame.tangent);
  } else {
    const Frame any(n);
    frame.tangent = any.tangent;
    frame.bitangent = any.bitangent;
  }
  frame.normal = n * side;
  return frame;
}

Materials::Materials(const Manifest& manifest, const Textures& textures)
    : manifest_(manifest),
      textures_(textures),
      plastic_table_(manifest.materials.size()),
      luminance_(manifest.materials.size(), 1) {
  for (const ScatteringTable& table : manifest.tables) tables_.push_back(loaded_table(table));
  const std::vector<MaterialTraits> traits = traits_of(manifest.materials);
  std::vector<Straight> straights;
  std::map<std::tuple<float, float, Roughness::Distribution, Masking>, std::uint32_t> known;
  for (std::size_t i = 0; i < manifest.materials.size(); ++i) {
    const auto* glass = std::get_if<DielectricMaterial>(&manifest.materials[i].model);
    straights.push_back(straight_of(straights, manifest.materials[i]));
    const MaterialKind kind{
        .is_interface = traits[i].nothing,
        .is_fibre = traits[i].fibre,
        .transmits = traits[i].transmits,
        .smooth_dielectric = glass && is_smooth(glass->roughness),
        .dispersive = traits_of(manifest.materials[i].model).disperses,
        .diffuse = traits[i].gathers,
        .opaque = stops_light(manifest.materials, i) && manifest.materials[i].casts_shadow,
        .sheet = straights.back().passes && straights.back().mirrors,
        .along_surface = has_direction(manifest.materials[i].model, manifest.tables)};
    have_panes_ = have_panes_ || kind.sheet || kind.smooth_dielectric;
    kinds_.push_back(kind);
    if (const auto* principled = std::get_if<PrincipledMaterial>(&manifest.materials[i].model))
      if (const auto* color = std::get_if<Spectrum>(&principled->base_color); color && has_tint(*principled))
        luminance_[i] = luminance(*color);
    const auto* plastic = std::get_if<PlasticMaterial>(&manifest.materials[i].model);
    if (!plastic) continue;
    // A textured width is tabulated by what it is in the middle.
    const auto* alpha = std::get_if<float>(&plastic->roughness.alpha_u);
    const float eta = plastic->eta / plastic->exterior_eta, width = alpha ? *alpha : 0.3f;
    const auto& [distribution, masking] =
        std::tie(plastic->roughness.distribution, plastic->roughness.masking);
    const auto [at, is_new] = known.try_emplace({width, eta, distribution, masking},
                                                static_cast<std::uint32_t>(plastic_tables_.size()));
    if (is_new)
      plastic_tables_.push_back(plastic_tables(
          static_cast<double>(eta),
          make_microfacets(static_cast<double>(width), static_cast<double>(width), distribution, masking)));
    plastic_table_[i] = at->second;
  }
}

const Material* Materials::choose(std::uint32_t material, const Interaction& at,
                                  MaterialNumbers& numbers) const {
  for (;;) {
    const Material& m = manifest_.materials[material];
    if (const auto* sided = std::get_if<TwoSidedMaterial>(&m.model)) {
      material = (at.front ? sided->front : sided->back).value;
    } else if (const auto* blend = std::get_if<BlendMaterial>(&m.model)) {
      const double amount = textures_.number(blend->amount, at.texture_point());
      material = (numbers.next() < amount ? blend->second : blend->first).value;
    } else if (const auto* mask = std::get_if<MaskMaterial>(&m.model)) {
      if (numbers.next() >= textures_.number(mask->opacity, at.texture_point())) return nullptr;
      material = mask->material.value;
    } else {
      return is_nothing(m, at.front) ? nullptr : &m;
    }
  }
}

// What parts of a material have in common with light, by their shares: of_part(material) of each.
template <class OfPart>
SampledSpectrum Materials::mixed(std::uint32_t material, const Interaction& at, float of_nothing,
                                 const OfPart& of_part) const {
  const Material& m = manifest_.materials[material];
  const auto part = [&](Id<Material> id) { return mixed(id.value, at, of_nothing, of_part); };
  const auto share = [&](const FloatParameter& p) {
    return static_cast<float>(std::clamp(textures_.number(p, at.texture_point()), 0.0, 1.0));
  };
  if (const auto* sided = std::get_if<TwoSidedMaterial>(&m.model))
    return part(at.front ? sided->front : sided->back);
  if (const auto* blend = std::get_if<BlendMaterial>(&m.model)) {
    const float amount = share(blend->amount);
    return part(blend->first) * (1 - amount) + part(blend->second) * amount;
  }
  if (const auto* mask = std::get_if<MaskMaterial>(&m.model)) {
    const float opacity = share(mask->opacity);
    return filled(of_nothing * (1 - opacity)) + part(mask->material) * opacity;
  }
  return is_nothing(m, at.front) ? filled(of_nothing) : of_part(m);
}

BsdfMaker Materials::maker_at(const TexturePoint& at, const SampledWavelengths& wavelengths) const {
  return {textures_, at, wavelengths, nullptr, nullptr, filled(1), 0, 1, {}};
}

Bsdf Materials::bsdf_at(const Material& material, const TexturePoint& at,
                        const SampledWavelengths& wavelengths) const {
  BsdfMaker maker = maker_at(at, wavelengths);
  maker.luminance = luminance_[index_of(material)];
  if (!plastic_tables_.empty()) maker.plastic_tables = &plastic_tables_[plastic_table_[index_of(material)]];
  return std::visit(maker, material.model);
}

SampledSpectrum Materials::passes_straight(std::uint32_t material, const Interaction& at,
                                           const SampledWavelengths& wavelengths, double q) const {
  const double cosine = std::abs(dot(at.out, at.shading));
  return mixed(material, at, 1, [&](const Material& m) -> SampledSpectrum {
    if (const auto* measured = std::get_if<MeasuredMaterial>(&m.model))
      return sheet_fractions(*measured->sheet, wavelengths, cosine).transmitted;
    if (const auto* thin = std::get_if<ThinDielectricMaterial>(&m.model))
      return straight_transmittance(maker_at(at.texture_point(), wavelengths).thin(*thin), cosine, q);
    if (const auto* slab = std::get_if<SlabMaterial>(&m.model))
      return straight_transmittance(maker_at(at.texture_point(), wavelengths).slab(*slab), cosine);
    if (const auto* glazed = std::get_if<GlazedMaterial>(&m.model))
      return textures_.spectrum(glazed->through, at.texture_point(), wavelengths);
    return {};
  });
}

SampledSpectrum Materials::mirrors(std::uint32_t material, const Interaction& at,
                                   const SampledWavelengths& wavelengths, double q) const {
  const double cosine = std::abs(dot(at.out, at.shading));
  return mixed(material, at, 0, [&](const Material& m) -> SampledSpectrum {
    if (const auto* measured = std::get_if<MeasuredMaterial>(&m.model))
      return sheet_fractions(*measured->sheet, wavelengths, cosine).reflected;
    if (const auto* thin = std::get_if<ThinDielectricMaterial>(&m.model))
      return mirrored_share(maker_at(at.texture_point(), wavelengths).thin(*thin), cosine, q);
    const auto* metal = std::get_if<ConductorMaterial>(&m.model);
    if (!metal || !scatters(m, at)) return {};
    const Bsdf bsdf = maker_at(at.texture_point(), wavelengths)(*metal);
    if (!is_specular(bsdf)) return {};
    const auto chosen = sample(bsdf, {safe_sqrt(1 - cosine * cosine), 0, cosine}, 0, {});
    return chosen ? chosen->weight : SampledSpectrum{};
  });
}

Vector3d Materials::shading_normal(const Material& material, const Interaction& at, bool any_normal) const {
  Vector3d n = tilted(material, at, manifest_, textures_);
  // A pattern may turn the normal away from the ray, as POV-Ray's: what is as bright from all directions
  // shows it as it is.
  if (any_normal && bumps_of(material, manifest_)) return n;
  // A normal that the ray sees from the other side than the surface is turned around the smooth one, to face
  // the ray (Schüssler et al., "Microfacet-Based Normal Mapping for Robust Monte Carlo Path Tracing", 2017).
  const auto usable = [&] { return dot(n, n) > 0.5 && (dot(at.out, n) > 0) == at.front; };
  if (!usable()) n = at.shading * (2 * dot(n, at.shading)) - n;
  return usable() ? n : at.shading;
}

Vector3d Materials::tangent(const Material& material, const Interaction& at) const {
  if (!kind(index_of(material)).along_surface) return {};
  const auto* hair = std::get_if<HairMaterial>(&material.model);
  const Vector3d along = hair && hair->along_v ? at.dpdv : at.dpdu;
  return material.normal_map ? along - at.shading * dot(at.shading, along) : along;
}

bool Materials::scatters(const Material& material, const Interaction& at) const {
  return at.front || material.two_sided || kind(index_of(material)).transmits;
}

Scattering Materials::scattering_at(const Material& material, const Interaction& at,
                                    const SampledWavelengths& wavelengths, const SampledSpectrum& throughput,
                                    std::uint64_t event) const {
  const bool both_sides = kind(index_of(material)).transmits;
  const BsdfMaker maker{
      textures_,
      at.texture_point(),
      wavelengths,
      at.exterior_eta,
      plastic_tables_.empty() ? nullptr : &plastic_tables_[plastic_table_[index_of(material)]],
      throughput,
      event,
      luminance_[index_of(material)],
      tables_};
  Bsdf bsdf = std::visit(maker, material.model);
  const Vector3d normal = shading_normal(material, at, takes_any_normal(bsdf));
  return Scattering{bsdf, frame_around(normal, tangent(material, at), both_sides ? 1.0 : at.side()),
                    both_sides, material.bump_shadowing ? bump_alpha2(dot(normal, at.shading)) : 0};
}

namespace {

double tangent2(double cosine) {
  const double c2 = std::clamp(cosine * cosine, 1e-12, 1.0);
  return (1 - c2) / c2;
}

}  // namespace

double bump_alpha2(double cosine) { return std::min(0.125 * tangent2(cosine), 1.0); }

double Scattering::bump_shadowing(double cosine) const {
  return bump_alpha2 > 0 ? 2 / (1 + std::sqrt(1 + bump_alpha2 * tangent2(cosine))) : 1;
}

SampledSpectrum relative_index(const DielectricMaterial& material, const Interaction& at,
                               const SampledWavelengths& wavelengths) {
  const SampledSpectrum behind = evaluate(material.eta, wavelengths),
                        before =
                            evaluate(at.exterior_eta ? *at.exterior_eta : material.exterior_eta, wavelengths);
  SampledSpectrum eta;
  for (std::size_t i = 0; i < hero_count; ++i)
    eta.v[i] = at.front ? behind.v[i] / before.v[i] : before.v[i] / behind.v[i];
  return eta;
}

double near_index(const DielectricMaterial& material, const Interaction& at,
                  const SampledWavelengths& wavelengths) {
  const Spectrum& before = at.exterior_eta ? *at.exterior_eta : material.exterior_eta;
  return static_cast<double>(
      evaluate(at.front ? before : material.eta, static_cast<double>(wavelengths.lambda_nm[0])));
}

}  // namespace vitrail
