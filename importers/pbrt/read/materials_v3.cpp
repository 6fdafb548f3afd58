// SPDX-License-Identifier: Apache-2.0
// pbrt-v3's materials in terms of v4's, and of blends and masks of them where one does not suffice.
#include <algorithm>
#include <array>
#include <cmath>

#include "importers/pbrt/read/material_parameters.h"
#include "importers/spectra/greatest_value.h"

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

SpectrumParameter times(const Maker& m, const SpectrumParameter& a, const SpectrumParameter& b) {
  const auto *first = std::get_if<Spectrum>(&a), *second = std::get_if<Spectrum>(&b);
  if (first && second) return product(*first, *second);
  if (is(a, 1)) return b;
  if (is(b, 1)) return a;
  m.scope.made.push_back({ProductTexture{a, b}, false, "", m.scope.origin});
  return Id<Texture>{static_cast<std::uint32_t>(m.scope.made.size() - 1)};
}

SpectrumParameter over(const Maker& m, const SpectrumParameter& a, double divisor) {
  return times(m, a, Maker::grey(1 / divisor));
}

// v3 adds lobes: a blend of a part Kd/(1 − w) and a part K/w with the share w of the second is Kd + K. Where
// it can, w is K, as then the second part is that of a coat and not a multiple of it; w leaves the first a
// reflectance of at most 1.
double share_of(double diffuse, double other) {
  constexpr double least = 0.05;
  return std::clamp(other, least, std::max(least, 1 - diffuse));
}

MaterialModel blended(const Maker& m, MaterialModel first, MaterialModel second, double share) {
  const Id<Material> a = m.slots.add({std::move(first)}), b = m.slots.add({std::move(second)});
  return BlendMaterial{a, b, static_cast<float>(share)};
}

// K times a Fresnel factor, by microfacets or of a mirror: a plastic of a black base.
PlasticMaterial gloss(const Maker& m, const SpectrumParameter& k, const Spectrum& eta, Roughness roughness) {
  PlasticMaterial p;
  p.diffuse_reflectance = Maker::grey(0);
  p.specular_reflectance = k;
  p.eta = static_cast<float>(is_constant(eta) ? evaluate(eta, lambda_min_nm) : luminance(eta));
  p.exterior_eta = 1;
  if (roughness.alpha_u != roughness.alpha_v) {
    m.approximated("the two widths of its gloss become the first of them");
    roughness.alpha_v = roughness.alpha_u;
  }
  p.roughness = roughness;
  return p;
}

// Lambert and a gloss of Ks.
MaterialModel diffuse_and_gloss(const Maker& m, const SpectrumParameter& kd, const SpectrumParameter& ks,
                                const Spectrum& eta, const Roughness& roughness) {
  if (is(ks, 0)) return DiffuseMaterial{kd};
  if (is(kd, 0)) return gloss(m, ks, eta, roughness);
  const double share = share_of(greatest_value(kd), greatest_value(ks));
  return blended(m, DiffuseMaterial{over(m, kd, 1 - share)}, gloss(m, over(m, ks, share), eta, roughness),
                 share);
}

MaterialModel plastic(const Maker& m) {
  return diffuse_and_gloss(m, m.reflectance({"Kd"}, 0.25), m.reflectance({"Ks"}, 0.25), Maker::grey(1.5),
                           m.roughness(0.1));
}

// Ashikhmin and Shirley (2000): Ks is the reflectance at normal incidence, and Kd·(1 − Ks) is left below it,
// as in a plastic whose index has that reflectance.
MaterialModel substrate(const Maker& m) {
  if (m.parameters.find("d", {ParameterType::number})) m.dropped("the absorption depth d of its coat");
  const SpectrumParameter kd = m.reflectance({"Kd"}, 0.5), ks = m.reflectance({"Ks"}, 0.5);
  const double reflectance = std::clamp(mean(ks), 0.0, 0.95), root = std::sqrt(reflectance);
  m.approximated(fmt::format("a plastic with its reflectance at normal incidence, {:.3g}, stands for it{}",
                             reflectance,
                             std::holds_alternative<Spectrum>(ks) ? "" : " (Ks is a texture: 0.5)"));
  if (reflectance == 0) return DiffuseMaterial{kd};
  const double eta = (1 + root) / (1 - root);
  const Roughness roughness = m.roughness(0.1);
  if (roughness.alpha_u != roughness.alpha_v) return CoatedDiffuseMaterial{kd, Maker::grey(eta), roughness};
  PlasticMaterial p;
  p.diffuse_reflectance = kd;
  p.eta = static_cast<float>(eta);
  p.exterior_eta = 1;
  p.roughness = roughness;
  return p;
}

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

struct UberColors {
  SpectrumParameter kd, ks, kr, kt;
};

// Beside Lambert and its gloss a mirror of Kr, or with Kt a smooth dielectric of both.
MaterialModel uber_lobes(const Maker& m, const UberColors& k, const Spectrum& eta,
                         const Roughness& roughness) {
  if (is(k.kr, 0) && is(k.kt, 0)) return diffuse_and_gloss(m, k.kd, k.ks, eta, roughness);
  const auto smooth = [&](double weight) -> MaterialModel {
    const SpectrumParameter reflected = over(m, k.kr, weight);
    if (is(k.kt, 0)) return gloss(m, reflected, eta, {});
    return DielectricMaterial{eta, Maker::grey(1), {}, reflected, over(m, k.kt, weight)};
  };
  if (is(k.kd, 0) && is(k.ks, 0)) return smooth(1);
  const double share =
      share_of(greatest_value(k.kd), std::max(greatest_value(k.kr), greatest_value(k.kt)) / 2);
  MaterialModel others =
      diffuse_and_gloss(m, over(m, k.kd, 1 - share), over(m, k.ks, 1 - share), eta, roughness);
  return blended(m, std::move(others), smooth(share), share);
}

MaterialModel uber(const Maker& m) {
  const Spectrum eta = m.index({"eta", "index"}, 1.5);
  const SpectrumParameter kd = m.reflectance({"Kd"}, 0.25), ks = m.reflectance({"Ks"}, 0.25);
  const SpectrumParameter kr = m.reflectance({"Kr"}, 0), kt = m.reflectance({"Kt"}, 0);
  const SpectrumParameter opacity = m.reflectance({"opacity"}, 1);
  const Roughness roughness = m.roughness(0.1);

  MaterialModel model = uber_lobes(m, {kd, ks, kr, kt}, eta, roughness);
  if (is(opacity, 1)) return model;
  return MaskMaterial{as_number(m, opacity, "opacity"), m.slots.add({std::move(model)})};
}

MaterialModel translucent(const Maker& m) {
  const SpectrumParameter kd = m.reflectance({"Kd"}, 0.25), ks = m.reflectance({"Ks"}, 0.25);
  const SpectrumParameter reflect = m.reflectance({"reflect"}, 0.5),
                          transmit = m.reflectance({"transmit"}, 0.5);
  const Roughness roughness = m.roughness(0.1);
  const auto diffuse = [&](double weight) {
    return DiffuseTransmissionMaterial{times(m, over(m, kd, weight), reflect),
                                       times(m, over(m, kd, weight), transmit)};
  };
  const auto rough_glass = [&](double weight) {
    return DielectricMaterial{Maker::grey(1.5), Maker::grey(1), roughness,
                              times(m, over(m, ks, weight), reflect),
                              times(m, over(m, ks, weight), transmit)};
  };
  if (is(ks, 0)) return diffuse(1);
  if (is(kd, 0)) return rough_glass(1);
  const double share = share_of(greatest_value(kd), greatest_value(ks));
  return blended(m, diffuse(1 - share), rough_glass(share), share);
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
  const Parameter* file = m.parameters.find("bsdffile", {ParameterType::text});
  if (!file || file->strings.size() != 1)
    fail("a fourier material needs a \"string bsdffile\"", m.parameters.place());
  return TabulatedMaterial{TabulatedMaterial::Format::fourier, find_file(*file, m.scope.context)};
}

struct V3MaterialKind {
  std::string_view name;
  MaterialModel (*make)(const Maker&);
};
constexpr std::array<V3MaterialKind, 11> v3_material_kinds{{{"matte", matte},
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
  for (const V3MaterialKind& known : v3_material_kinds)
    if (m.kind == known.name) return known.make(m);
  return std::nullopt;
}

}  // namespace vitrail::pbrt
