// SPDX-License-Identifier: Apache-2.0
#include "scene/records/material_traits.h"

#include <algorithm>

namespace vitrail {

namespace {

constexpr Lobes smooth{.smooth = true}, spread{.spread = true};

Lobes interface(const Roughness& r) { return is_smooth(r) ? smooth : spread; }
// Over a base that spreads light.
Lobes coat(const Roughness& r) { return {is_smooth(r), true}; }

bool is_brushed(const Roughness& r) { return r.alpha_u != r.alpha_v; }

struct Traits {
  MaterialTraits operator()(const DiffuseMaterial&) const { return {.gathers = true, .lobes = spread}; }
  MaterialTraits operator()(const DielectricMaterial& m) const {
    return {.transmits = true,
            .disperses = !is_constant(m.eta) || !is_constant(m.exterior_eta),
            .along_surface = is_brushed(m.roughness),
            .lobes = interface(m.roughness)};
  }
  MaterialTraits operator()(const ThinDielectricMaterial&) const {
    return {.transmits = true, .straight = true, .counts = true, .mirrors = true, .lobes = smooth};
  }
  MaterialTraits operator()(const ConductorMaterial& m) const {
    return {.mirrors = is_smooth(m.roughness),
            .along_surface = is_brushed(m.roughness),
            .lobes = interface(m.roughness)};
  }
  MaterialTraits operator()(const PlasticMaterial& m) const {
    const bool smooth_coat = m.roughness.alpha_u == FloatParameter{0.0f};  // its only width: it is isotropic
    return {.gathers = smooth_coat, .lobes = {smooth_coat, true}};
  }
  MaterialTraits operator()(const CoatedDiffuseMaterial& m) const {
    return {.disperses = !is_constant(m.eta),
            .along_surface = is_brushed(m.roughness),
            .lobes = coat(m.roughness)};
  }
  MaterialTraits operator()(const CoatedConductorMaterial& m) const {
    const bool scatters = m.volume.albedo != SpectrumParameter{ConstantSpectrum{0}};
    const bool spreads = !is_smooth(m.interface_roughness) || !is_smooth(m.conductor_roughness) || scatters;
    return {.disperses = !is_constant(m.interface_eta),
            .along_surface = is_brushed(m.conductor_roughness) || is_brushed(m.interface_roughness),
            .lobes = {is_smooth(m.interface_roughness), spreads}};
  }
  MaterialTraits operator()(const DiffuseTransmissionMaterial&) const {
    return {.transmits = true, .gathers = true, .lobes = spread};
  }
  MaterialTraits operator()(const PrincipledMaterial& m) const {
    return {.transmits = m.thin || m.spec_trans != FloatParameter{0.0f},
            .along_surface = m.anisotropic != FloatParameter{0.0f},
            .lobes = spread};
  }
  MaterialTraits operator()(const SubsurfaceMaterial& m) const {
    return {.transmits = true, .along_surface = is_brushed(m.roughness), .lobes = interface(m.roughness)};
  }
  MaterialTraits operator()(const HairMaterial&) const {
    return {.transmits = true, .fibre = true, .along_surface = true, .lobes = spread};
  }
  MaterialTraits operator()(const MeasuredMaterial& m) const {
    if (!m.sheet) return {.lobes = spread};
    return {.transmits = true, .straight = true, .counts = true, .mirrors = true, .lobes = smooth};
  }
  MaterialTraits operator()(const InterfaceMaterial&) const {
    return {.transmits = true, .straight = true, .nothing = true};
  }
  MaterialTraits operator()(const BlendMaterial&) const { return {}; }
  MaterialTraits operator()(const MaskMaterial&) const {
    return {.transmits = true, .straight = true, .counts = true};
  }
  MaterialTraits operator()(const TwoSidedMaterial&) const { return {}; }
  MaterialTraits operator()(const TabulatedMaterial& m) const {
    const bool fourier = m.format == TabulatedMaterial::Format::fourier;
    return {.transmits = fourier, .along_surface = !fourier, .lobes = spread};
  }
  MaterialTraits operator()(const SlabMaterial&) const {
    return {.transmits = true, .straight = true, .counts = true, .lobes = spread};
  }
  MaterialTraits operator()(const FinishMaterial&) const { return {.gathers = true, .lobes = spread}; }
  MaterialTraits operator()(const GlazedMaterial& m) const {
    const bool clear = m.through != SpectrumParameter{ConstantSpectrum{0}};
    return {.transmits = clear, .straight = clear, .counts = clear, .lobes = {true, true}};
  }
};

// What a part has, a material made of it has too; but for what it counts, which is said where it is met.
void add(MaterialTraits& whole, const MaterialTraits& part) {
  whole.transmits |= part.transmits;
  whole.straight |= part.straight;
  whole.mirrors |= part.mirrors;
  whole.gathers |= part.gathers;
  whole.disperses |= part.disperses;
  whole.along_surface |= part.along_surface;
  whole.lobes.smooth |= part.lobes.smooth;
  whole.lobes.spread |= part.lobes.spread;
}

struct Parts {
  using Ids = std::vector<Id<Material>>;
  Ids operator()(const BlendMaterial& m) const { return {m.first, m.second}; }
  Ids operator()(const MaskMaterial& m) const { return {m.material}; }
  Ids operator()(const TwoSidedMaterial& m) const { return {m.front, m.back}; }
  // A reference to a material that is not named above does not compile.
  template <class M>
  Ids operator()(const M&) const {
    static_assert(
        !requires(M m) { m.material; } && !requires(M m) { m.first; } && !requires(M m) { m.front; });
    return {};
  }
};

}  // namespace

bool is_smooth(const Roughness& r) {
  return r.alpha_u == FloatParameter{0.0f} && r.alpha_v == FloatParameter{0.0f};
}

std::vector<Id<Material>> parts_of(const MaterialModel& model) { return std::visit(Parts{}, model); }

bool has_direction(const MaterialModel& model, const std::vector<ScatteringTable>& tables) {
  const auto* tabulated = std::get_if<TabulatedMaterial>(&model);
  const auto* table = tabulated ? std::get_if<AdaptiveTable>(&tables.at(tabulated->table.value)) : nullptr;
  return traits_of(model).along_surface && !(table && is_isotropic(*table));
}

MaterialTraits traits_of(const MaterialModel& model) { return std::visit(Traits{}, model); }

MaterialTraits traits_of(const Material& material, const std::vector<MaterialTraits>& others) {
  MaterialTraits traits = traits_of(material.model);
  const std::vector<Id<Material>> parts = parts_of(material.model);
  for (const Id<Material> part : parts) add(traits, others.at(part.value));
  const auto is_fibre = [&](Id<Material> part) { return others[part.value].fibre; };
  const auto is_nothing = [&](Id<Material> part) { return others[part.value].nothing; };
  if (std::holds_alternative<BlendMaterial>(material.model))
    traits.counts = std::ranges::any_of(parts, is_nothing);
  // Sides are chosen before what is there from behind is asked.
  if (!parts.empty() && !std::holds_alternative<TwoSidedMaterial>(material.model))
    traits.fibre = std::ranges::all_of(parts, is_fibre);
  return traits;
}

std::vector<MaterialTraits> traits_of(const std::vector<Material>& materials) {
  std::vector<MaterialTraits> result;
  for (const Material& material : materials) result.push_back(traits_of(material, result));
  return result;
}

bool has_sides(const Material& material, const MaterialTraits& traits, const std::vector<bool>& others) {
  if (traits.nothing) return false;
  if (const auto* mask = std::get_if<MaskMaterial>(&material.model)) return others.at(mask->material.value);
  if (const auto* blend = std::get_if<BlendMaterial>(&material.model))
    return others.at(blend->first.value) || others.at(blend->second.value);
  const bool bumps = material.displacement || material.normal_map;  // which the front's normal is turned by
  return !material.two_sided || traits.transmits || bumps ||
         std::holds_alternative<TwoSidedMaterial>(material.model);
}

std::vector<bool> with_sides(const std::vector<Material>& materials) {
  const std::vector<MaterialTraits> traits = traits_of(materials);
  std::vector<bool> result;
  for (std::size_t i = 0; i < materials.size(); ++i)
    result.push_back(has_sides(materials[i], traits[i], result));
  return result;
}

bool blends_mirror_with_spread(const Material& material, const std::vector<MaterialTraits>& others) {
  const auto* blend = std::get_if<BlendMaterial>(&material.model);
  if (!blend) return false;
  const Lobes first = others.at(blend->first.value).lobes, second = others.at(blend->second.value).lobes;
  return (first.smooth && second.spread) || (first.spread && second.smooth);
}

}  // namespace vitrail
