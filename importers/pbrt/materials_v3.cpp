// SPDX-License-Identifier: Apache-2.0
// pbrt-v3's materials in terms of v4's, and of blends and masks of them where one does not suffice.
#include <array>

#include "importers/pbrt/material_parameters.h"

namespace vitrail::pbrt {

namespace {

using Maker = MaterialMaker;

// Whatever form the value has: a colour, a number.
bool is(const SpectrumParameter& parameter, double value) {
  const auto* spectrum = std::get_if<Spectrum>(&parameter);
  return spectrum && is_constant(*spectrum) && evaluate(*spectrum, lambda_min_nm) == value;
}

SpectrumParameter factor(const Maker& m, std::string_view name) {
  const SpectrumParameter value = m.reflectance({name}, 1);
  return is(value, 1) ? SpectrumParameter{Maker::grey(1)} : value;
}

double mean(const SpectrumParameter& parameter) {
  const auto* value = std::get_if<Spectrum>(&parameter);
  return value ? luminance(*value) : 0.5;
}

MaterialModel matte(const Maker& m) {
  return DiffuseMaterial{m.reflectance({"Kd"}, 0.5), m.number("sigma", 0)};
}

MaterialModel glass(const Maker& m) {
  DielectricMaterial d;
  d.eta = m.index({"eta", "index"}, 1.5);
  d.roughness = m.roughness(0);
  d.reflectance_factor = factor(m, "Kr");
  d.transmittance_factor = factor(m, "Kt");
  return d;
}

MaterialModel mirror(const Maker& m) {
  return ConductorMaterial{PerfectReflector{}, {}, m.reflectance({"Kr"}, 0.9)};
}

MaterialModel metal(const Maker& m) { return ConductorMaterial{m.metal(), m.roughness(0.01)}; }

// The gloss of v3 is Ks times a Fresnel factor of index 1.5, added to the diffuse part; v4's coat has that
// index.
CoatedDiffuseMaterial coated(const Maker& m, double kd, double ks, double roughness, const Spectrum& eta) {
  const SpectrumParameter gloss = m.reflectance({"Ks"}, ks);
  m.approximated(
      is(gloss, 1) ? "the coat's model is v4's"
                   : fmt::format("the coat's model is v4's: Ks, {:.2f} on average, becomes 1", mean(gloss)));
  CoatedDiffuseMaterial c;
  c.reflectance = m.reflectance({"Kd"}, kd);
  c.eta = eta;
  c.roughness = m.roughness(roughness);
  return c;
}

MaterialModel plastic(const Maker& m) { return coated(m, 0.25, 0.25, 0.1, Maker::grey(1.5)); }

MaterialModel substrate(const Maker& m) {
  if (m.parameters.find("d", {ParameterType::number})) m.dropped("the absorption depth d of its coat");
  return coated(m, 0.5, 0.5, 0.1, Maker::grey(1.5));
}

// Blends `base` with another material by the share of light that each is given; 0 and 1 need no blend.
MaterialModel blended(const Maker& m, MaterialModel base, MaterialModel other, double share,
                      const char* what) {
  if (share <= 0) return base;
  if (share >= 1) return other;
  m.approximated(fmt::format("{} becomes a share of {:.2f} of a blend", what, share));
  const Id<Material> first = m.slots.add({std::move(base)}), second = m.slots.add({std::move(other)});
  return BlendMaterial{first, second, static_cast<float>(share)};
}

// v3 adds its lobes; what is brighter gets the larger share of the light.
double share_of(double part, double others) { return part > 0 ? part / (part + std::max(others, 0.0)) : 0; }

FloatParameter as_number(const Maker& m, const SpectrumParameter& parameter, const char* name) {
  if (const auto* texture = std::get_if<Id<Texture>>(&parameter)) {
    m.approximated(fmt::format("the colours of the texture of its {} become their luminance", name));
    Texture copy = m.scope.made.at(texture->value);
    copy.is_float = true;
    m.scope.made.push_back(std::move(copy));
    return Id<Texture>{static_cast<std::uint32_t>(m.scope.made.size() - 1)};
  }
  const Spectrum& value = std::get<Spectrum>(parameter);
  if (is_constant(value)) return static_cast<float>(evaluate(value, lambda_min_nm));
  m.approximated(fmt::format("the colour of its {} becomes its luminance", name));
  return static_cast<float>(luminance(value));
}

MaterialModel uber(const Maker& m) {
  const Spectrum eta = m.index({"eta", "index"}, 1.5);
  const SpectrumParameter kd = m.reflectance({"Kd"}, 0.25), ks = m.reflectance({"Ks"}, 0.25);
  const SpectrumParameter kr = m.reflectance({"Kr"}, 0), kt = m.reflectance({"Kt"}, 0);
  const SpectrumParameter opacity = m.reflectance({"opacity"}, 1);
  const Roughness roughness = m.roughness(0.1);

  MaterialModel model = DiffuseMaterial{kd};
  if (!is(ks, 0)) {
    m.approximated(fmt::format("the coat's model is v4's: Ks, {:.2f} on average, becomes 1", mean(ks)));
    model = CoatedDiffuseMaterial{kd, eta, roughness};
  }
  // Kr and Kt are smooth: a dielectric's reflection and transmission.
  if (!is(kr, 0) || !is(kt, 0)) {
    DielectricMaterial d;
    d.eta = eta;
    d.reflectance_factor = kr;
    d.transmittance_factor = kt;
    model = is(kt, 0) ? blended(m, model, ConductorMaterial{PerfectReflector{}, {}, kr},
                                share_of(mean(kr), mean(kd) + mean(ks)), "its mirror (Kr)")
                      : blended(m, model, d, share_of(mean(kr) + mean(kt), mean(kd) + mean(ks)),
                                "its smooth reflection and transmission (Kr, Kt)");
  }
  if (is(opacity, 1)) return model;
  return MaskMaterial{as_number(m, opacity, "opacity"), m.slots.add({std::move(model)})};
}

SpectrumParameter times(const Maker& m, const SpectrumParameter& a, const SpectrumParameter& b) {
  const auto *first = std::get_if<Spectrum>(&a), *second = std::get_if<Spectrum>(&b);
  if (first && second) return product(*first, *second);
  if (is(a, 1)) return b;
  if (is(b, 1)) return a;
  m.scope.made.push_back({ProductTexture{a, b}, false, "", m.scope.origin});
  return Id<Texture>{static_cast<std::uint32_t>(m.scope.made.size() - 1)};
}

MaterialModel translucent(const Maker& m) {
  const SpectrumParameter kd = m.reflectance({"Kd"}, 0.25);
  const SpectrumParameter reflect = m.reflectance({"reflect"}, 0.5),
                          transmit = m.reflectance({"transmit"}, 0.5);
  if (!is(m.reflectance({"Ks"}, 0.25), 0)) m.dropped("the gloss Ks of a translucent surface");
  m.parameters.ignore({"roughness", "remaproughness"});
  return DiffuseTransmissionMaterial{times(m, kd, reflect), times(m, kd, transmit)};
}

MaterialModel disney(const Maker& m) {
  PrincipledMaterial p;
  p.base_color = m.reflectance({"color"}, 0.5);
  p.metallic = m.number("metallic", 0);
  p.eta = static_cast<float>(m.parameters.number("eta", 1.5));
  p.roughness = m.number("roughness", 0.5);
  p.spec_tint = m.number("speculartint", 0);
  p.anisotropic = m.number("anisotropic", 0);
  p.sheen = m.number("sheen", 0);
  p.sheen_tint = m.number("sheentint", 0.5);
  p.clearcoat = m.number("clearcoat", 0);
  p.clearcoat_gloss = m.number("clearcoatgloss", 1);
  p.spec_trans = m.number("spectrans", 0);
  p.flatness = m.number("flatness", 0);
  p.diff_trans = m.number("difftrans", 1);
  p.thin = m.parameters.boolean("thin", false);
  if (!is(m.unbounded({"scatterdistance"}, Maker::grey(0)), 0)) m.dropped("its scattering below the surface");
  return p;
}

MaterialModel fourier(const Maker& m) {
  m.parameters.ignore({"bsdffile"});
  m.dropped("v3's tables of Fourier coefficients: it becomes diffuse, 0.5");
  return DiffuseMaterial{};
}

struct Kind {
  std::string_view name;
  MaterialModel (*make)(const Maker&);
};
constexpr std::array<Kind, 11> kinds{{{"matte", matte},
                                      {"plastic", plastic},
                                      {"substrate", substrate},
                                      {"uber", uber},
                                      {"glass", glass},
                                      {"mirror", mirror},
                                      {"metal", metal},
                                      {"translucent", translucent},
                                      {"disney", disney},
                                      {"principled", disney},
                                      {"fourier", fourier}}};

}  // namespace

std::optional<MaterialModel> make_v3_material(const MaterialMaker& m) {
  for (const Kind& known : kinds)
    if (m.kind == known.name) return known.make(m);
  return std::nullopt;
}

}  // namespace vitrail::pbrt
