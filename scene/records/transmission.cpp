// SPDX-License-Identifier: Apache-2.0
#include "scene/records/transmission.h"

namespace vitrail {

namespace {

struct Transmits {
  const std::vector<bool>& others;

  bool operator()(const DielectricMaterial&) const { return true; }
  bool operator()(const ThinDielectricMaterial&) const { return true; }
  bool operator()(const DiffuseTransmissionMaterial&) const { return true; }
  bool operator()(const PrincipledMaterial& m) const {
    return m.thin || m.spec_trans != FloatParameter{0.0f};
  }
  bool operator()(const SubsurfaceMaterial&) const { return true; }
  bool operator()(const HairMaterial&) const { return true; }
  bool operator()(const TabulatedMaterial& m) const { return m.format == TabulatedMaterial::Format::fourier; }
  bool operator()(const SlabMaterial&) const { return true; }
  bool operator()(const InterfaceMaterial&) const { return true; }
  bool operator()(const MaskMaterial&) const { return true; }
  bool operator()(const BlendMaterial& m) const {
    return others.at(m.first.value) || others.at(m.second.value);
  }
  bool operator()(const TwoSidedMaterial& m) const {
    return others.at(m.front.value) || others.at(m.back.value);
  }
  bool operator()(const auto&) const { return false; }
};

}  // namespace

bool transmits(const Material& material, const std::vector<bool>& others) {
  return std::visit(Transmits{others}, material.model);
}

bool is_made_of_others(const Material& material) {
  return std::holds_alternative<BlendMaterial>(material.model) ||
         std::holds_alternative<MaskMaterial>(material.model) ||
         std::holds_alternative<TwoSidedMaterial>(material.model);
}

bool is_passed_straight(const Material& material, const std::vector<Material>& all) {
  const auto is_nothing = [&](Id<Material> part) {
    return std::holds_alternative<InterfaceMaterial>(all.at(part.value).model);
  };
  if (const auto* blend = std::get_if<BlendMaterial>(&material.model))
    return is_nothing(blend->first) || is_nothing(blend->second);
  return std::holds_alternative<MaskMaterial>(material.model) ||
         std::holds_alternative<ThinDielectricMaterial>(material.model) ||
         std::holds_alternative<MeasuredMaterial>(material.model) ||
         std::holds_alternative<SlabMaterial>(material.model);
}

bool lets_straight(const Material& material, const std::vector<bool>& others) {
  if (const auto* blend = std::get_if<BlendMaterial>(&material.model))
    return others.at(blend->first.value) || others.at(blend->second.value);
  if (const auto* sided = std::get_if<TwoSidedMaterial>(&material.model))
    return others.at(sided->front.value) || others.at(sided->back.value);
  return std::holds_alternative<InterfaceMaterial>(material.model) ||
         std::holds_alternative<MaskMaterial>(material.model) ||
         std::holds_alternative<ThinDielectricMaterial>(material.model) ||
         std::holds_alternative<SlabMaterial>(material.model);
}

bool has_sides(const Material& material, bool lets_through, const std::vector<bool>& others) {
  if (std::holds_alternative<InterfaceMaterial>(material.model)) return false;
  if (const auto* mask = std::get_if<MaskMaterial>(&material.model)) return others.at(mask->material.value);
  if (const auto* blend = std::get_if<BlendMaterial>(&material.model))
    return others.at(blend->first.value) || others.at(blend->second.value);
  const bool bumps = material.displacement || material.normal_map;  // which the front's normal is turned by
  return !material.two_sided || lets_through || bumps ||
         std::holds_alternative<TwoSidedMaterial>(material.model);
}

namespace {

Lobes either(Lobes a, Lobes b) { return {a.smooth || b.smooth, a.spread || b.spread}; }

struct LobesOf {
  const std::vector<Lobes>& others;

  static Lobes interface(const Roughness& r) {
    const bool smooth = r.alpha_u == FloatParameter{0.0f} && r.alpha_v == FloatParameter{0.0f};
    return {smooth, !smooth};
  }
  Lobes operator()(const DielectricMaterial& m) const { return interface(m.roughness); }
  Lobes operator()(const ThinDielectricMaterial&) const { return {true, false}; }
  Lobes operator()(const ConductorMaterial& m) const { return interface(m.roughness); }
  Lobes operator()(const SubsurfaceMaterial& m) const { return interface(m.roughness); }
  Lobes operator()(const PlasticMaterial& m) const { return {interface(m.roughness).smooth, true}; }
  Lobes operator()(const CoatedDiffuseMaterial& m) const { return {interface(m.roughness).smooth, true}; }
  Lobes operator()(const InterfaceMaterial&) const { return {}; }
  Lobes operator()(const MaskMaterial& m) const { return others.at(m.material.value); }
  Lobes operator()(const BlendMaterial& m) const {
    return either(others.at(m.first.value), others.at(m.second.value));
  }
  Lobes operator()(const TwoSidedMaterial& m) const {
    return either(others.at(m.front.value), others.at(m.back.value));
  }
  Lobes operator()(const auto&) const { return {false, true}; }
};

}  // namespace

Lobes lobes_of(const Material& material, const std::vector<Lobes>& others) {
  return std::visit(LobesOf{others}, material.model);
}

bool blends_mirror_with_spread(const Material& material, const std::vector<Lobes>& others) {
  const auto* blend = std::get_if<BlendMaterial>(&material.model);
  if (!blend) return false;
  const Lobes first = others.at(blend->first.value), second = others.at(blend->second.value);
  return (first.smooth && second.spread) || (first.spread && second.smooth);
}

std::vector<Lobes> lobes_of(const std::vector<Material>& materials) {
  std::vector<Lobes> result;
  for (const Material& material : materials) result.push_back(lobes_of(material, result));
  return result;
}

std::vector<bool> with_sides(const std::vector<Material>& materials) {
  const std::vector<bool> through = transmitting(materials);
  std::vector<bool> result;
  for (std::size_t i = 0; i < materials.size(); ++i)
    result.push_back(has_sides(materials[i], through[i], result));
  return result;
}

std::vector<bool> transmitting(const std::vector<Material>& materials) {
  std::vector<bool> result;
  for (const Material& material : materials) result.push_back(transmits(material, result));
  return result;
}

}  // namespace vitrail
