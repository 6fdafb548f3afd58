// SPDX-License-Identifier: Apache-2.0
// Which model a material is of, and what its extensions add.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/gltf/read/extension_values.h"
#include "importers/gltf/read/material_builder.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::gltf {

namespace {

constexpr double helium_d_nm = 587.6, hydrogen_f_nm = 486.1, hydrogen_c_nm = 656.3;

// Of light from vacuum at normal incidence.
double reflectance_of(double eta) { return std::pow((eta - 1) / (eta + 1), 2); }
double eta_of_reflectance(double f0) { return (1 + std::sqrt(f0)) / (1 - std::sqrt(f0)); }

bool is_zero(const FloatParameter& parameter) { return parameter == FloatParameter{0.0f}; }

// What lets a colour through at a distance: the logarithm of its spectrum. Spectra of the logarithms of its
// numbers would let another colour through.
Spectrum absorption(RGB color, double distance) {
  constexpr double least = 1e-4;  // what is darker absorbs no more
  const SigmoidSpectrum through = reflectance_from_rgb(color);
  const auto coefficient = [&](double nm) {
    return -std::log(std::clamp(evaluate(through, nm), least, 1.0)) / distance;
  };
  if (is_constant(through)) return ConstantSpectrum{static_cast<float>(coefficient(lambda_min_nm))};
  std::vector<SpectrumSample> samples;
  for (int i = 0; i < table_size; ++i) samples.push_back({lambda_min_nm + i, coefficient(lambda_min_nm + i)});
  return tabulate(samples, true);
}

}  // namespace

MaterialModel MaterialBuilder::model() {
  if (extension("KHR_materials_unlit")) {
    approximated("unlit: it shines with its colour, also on what is around");
    return DiffuseMaterial{Spectrum{ConstantSpectrum{0}}};
  }
  const tinygltf::Value* transmission = extension("KHR_materials_transmission");
  const tinygltf::Value* volume = extension("KHR_materials_volume");
  const double amount = transmission ? gltf::number(*transmission, "transmissionFactor", 0) : 0;
  const bool solid = volume && gltf::number(*volume, "thicknessFactor", 0) > 0;
  const auto& pbr = m_.pbrMetallicRoughness;
  if (amount == 1 && !texture_info(*transmission, "transmissionTexture") && pbr.metallicFactor == 0 &&
      pbr.metallicRoughnessTexture.index < 0 && (solid || pbr.roughnessFactor == 0))
    return glass(solid);
  return principled();
}

MaterialModel MaterialBuilder::glass(bool solid) {
  for (const char* name : {"KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy",
                           "KHR_materials_specular"})
    if (extension(name)) note(Fidelity::dropped, fmt::format("{} of glass", name));
  SpectrumParameter tint = base_color();
  const auto* constant = std::get_if<Spectrum>(&tint);
  if (const auto* sigmoid = constant ? std::get_if<SigmoidSpectrum>(constant) : nullptr;
      sigmoid && sigmoid->rgb == std::array<float, 3>{1, 1, 1})
    tint = Spectrum{ConstantSpectrum{1}};
  if (!solid) {
    ThinDielectricMaterial sheet;
    sheet.eta = dispersed_eta();
    sheet.transmittance_factor = tint;
    return sheet;
  }
  DielectricMaterial glass;
  glass.eta = dispersed_eta();
  glass.transmittance_factor = tint;
  const double roughness = held("roughnessFactor", m_.pbrMetallicRoughness.roughnessFactor, 0, 1);
  glass.roughness.alpha_u = glass.roughness.alpha_v = static_cast<float>(roughness * roughness);
  return glass;
}

MaterialModel MaterialBuilder::principled() {
  const auto& pbr = m_.pbrMetallicRoughness;
  PrincipledMaterial material{.below = true};
  material.base_color = base_color();
  const auto* map = &pbr.metallicRoughnessTexture;
  material.roughness = number(map, held("roughnessFactor", pbr.roughnessFactor, 0, 1), ImageNumber::green);
  material.metallic = number(map, held("metallicFactor", pbr.metallicFactor, 0, 1), ImageNumber::blue);
  material.eta = eta();
  if (const tinygltf::Value* t = extension("KHR_materials_transmission")) {
    const auto info = texture_info(*t, "transmissionTexture");
    const double amount = held("transmissionFactor", gltf::number(*t, "transmissionFactor", 0), 0, 1);
    material.spec_trans = amount > 0 ? number(info ? &*info : nullptr, amount, ImageNumber::red) : 0.0f;
    const tinygltf::Value* volume = extension("KHR_materials_volume");
    if (amount > 0 && !(volume && gltf::number(*volume, "thicknessFactor", 0) > 0)) {
      material.thin = true;
      if (!is_zero(material.metallic))
        approximated("a metallic sheet that lets light through counts as no metal");
    }
    if (amount > 0) approximated("light that goes through is tinted by the root of the base colour");
  }
  coat(material), sheen(material), anisotropy(material), specular(material);
  const bool plain = is_zero(material.spec_trans) && is_zero(material.metallic) &&
                     is_zero(material.clearcoat) && is_zero(material.sheen);
  if (plain && material.eta == 1)
    return DiffuseMaterial{material.base_color};  // no reflection: glTF's is Lambert's
  if (extension("KHR_materials_iridescence")) note(Fidelity::dropped, "KHR_materials_iridescence");
  return material;
}

float MaterialBuilder::eta() const {
  const tinygltf::Value* ior = extension("KHR_materials_ior");
  const double value = ior ? gltf::number(*ior, "ior", 1.5) : 1.5;
  if (value == 0) return static_cast<float>(held("ior (0: infinite)", 1e3, 1, 100));
  return static_cast<float>(held("ior", value, 1, 100));
}

// Cauchy's n = a + b/λ² of the Abbe number 20/dispersion.
Spectrum MaterialBuilder::dispersed_eta() const {
  const double n = static_cast<double>(eta());
  const tinygltf::Value* d = extension("KHR_materials_dispersion");
  const double dispersion = d ? gltf::number(*d, "dispersion", 0) : 0;
  if (dispersion <= 0) return ConstantSpectrum{static_cast<float>(n)};
  const auto per_square = [](double nm) { return 1 / (nm * nm); };
  const double b = (n - 1) * dispersion / 20 / (per_square(hydrogen_f_nm) - per_square(hydrogen_c_nm));
  const double a = n - b * per_square(helium_d_nm);
  std::vector<SpectrumSample> samples;
  for (int i = 0; i < table_size; i += 10) {
    const double nm = lambda_min_nm + i;
    samples.push_back({nm, std::max(a + b * per_square(nm), 1.0)});
  }
  return tabulate(samples, true);
}

void MaterialBuilder::coat(PrincipledMaterial& material) const {
  const tinygltf::Value* c = extension("KHR_materials_clearcoat");
  const double factor = c ? held("clearcoatFactor", gltf::number(*c, "clearcoatFactor", 0), 0, 1) : 0;
  if (factor <= 0) return;
  const auto info = texture_info(*c, "clearcoatTexture");
  material.clearcoat = number(info ? &*info : nullptr, factor, ImageNumber::red);
  // Burley's width is lerp(0.1, 0.001, gloss).
  const double roughness = gltf::number(*c, "clearcoatRoughnessFactor", 0);
  material.clearcoat_gloss = static_cast<float>(std::clamp((0.1 - roughness * roughness) / 0.099, 0.0, 1.0));
  approximated("clearcoat: Burley's, which reflects a quarter of that and takes nothing from below");
  if (texture_info(*c, "clearcoatRoughnessTexture")) note(Fidelity::dropped, "clearcoatRoughnessTexture");
  if (texture_info(*c, "clearcoatNormalTexture")) note(Fidelity::dropped, "clearcoatNormalTexture");
}

void MaterialBuilder::sheen(PrincipledMaterial& material) const {
  const tinygltf::Value* s = extension("KHR_materials_sheen");
  const RGB tint = s ? color(*s, "sheenColorFactor", {0, 0, 0}) : RGB{};
  const double most = std::max({tint.r, tint.g, tint.b});
  if (most <= 0) return;
  material.sheen = static_cast<float>(std::min(most, 1.0));
  approximated(fmt::format(
      "sheen of material \"{}\": Burley's, of one width and white, {:g} for its colour {:g} {:g} {:g}",
      m_.name, std::min(most, 1.0), tint.r, tint.g, tint.b));
  if (texture_info(*s, "sheenColorTexture")) note(Fidelity::dropped, "sheenColorTexture");
}

// glTF's widths are lerp(α, 1, s²) along the tangent and α across; Burley's α/a and α·a, a² = 1 −
// 0.9·anisotropic.
void MaterialBuilder::anisotropy(PrincipledMaterial& material) const {
  const tinygltf::Value* x = extension("KHR_materials_anisotropy");
  const double strength = x ? held("anisotropyStrength", gltf::number(*x, "anisotropyStrength", 0), 0, 1) : 0;
  if (strength <= 0) return;
  const auto* roughness = std::get_if<float>(&material.roughness);
  const double r = roughness ? static_cast<double>(*roughness) : 0.5;
  const double across = std::max(r * r, 1e-4), along = across + (1 - across) * strength * strength;
  material.anisotropic = static_cast<float>(std::min((1 - across / along) / 0.9, 1.0));
  if (roughness) material.roughness = static_cast<float>(std::min(std::pow(along * across, 0.25), 1.0));
  if (!roughness) approximated("anisotropy of a roughness by texture: as at 0.5, and no rougher");
  if (across / along < 0.1) approximated("anisotropy: widths of more than 10 to 1 count as that");
  if (gltf::number(*x, "anisotropyRotation", 0) != 0) note(Fidelity::dropped, "anisotropyRotation");
  if (texture_info(*x, "anisotropyTexture")) note(Fidelity::dropped, "anisotropyTexture");
}

// As an index of that reflectance at normal incidence.
void MaterialBuilder::specular(PrincipledMaterial& material) const {
  const tinygltf::Value* s = extension("KHR_materials_specular");
  if (!s) return;
  const double factor = held("specularFactor", gltf::number(*s, "specularFactor", 1), 0, 1);
  const RGB tint = color(*s, "specularColorFactor", {1, 1, 1});
  const double most = std::max({tint.r, tint.g, tint.b, 0.0});
  if (factor * most != 1) {
    const double f0 = std::min(reflectance_of(static_cast<double>(material.eta)) * factor * most, 0.9);
    material.eta = static_cast<float>(eta_of_reflectance(f0));
    if (f0 > 0) approximated("specular: an index with that reflectance at normal incidence");
  }
  if (tint.r != tint.g || tint.g != tint.b) note(Fidelity::dropped, "the hue of specularColorFactor");
  if (texture_info(*s, "specularTexture")) note(Fidelity::dropped, "specularTexture");
  if (texture_info(*s, "specularColorTexture")) note(Fidelity::dropped, "specularColorTexture");
}

std::optional<Id<Medium>> MaterialBuilder::interior() const {
  const tinygltf::Value* v = extension("KHR_materials_volume");
  const tinygltf::Value* t = extension("KHR_materials_transmission");
  if (!v || !t || gltf::number(*t, "transmissionFactor", 0) <= 0 ||
      gltf::number(*v, "thicknessFactor", 0) <= 0)
    return {};
  const double distance = gltf::number(*v, "attenuationDistance", 0);  // none: infinitely far
  const RGB c = color(*v, "attenuationColor", {1, 1, 1});
  if (distance <= 0 || c == RGB{1, 1, 1}) return {};
  Medium medium;
  medium.coefficients = AbsorptionScattering{absorption(c, distance), Spectrum{ConstantSpectrum{0}}};
  medium.origin = document_.origin("materials", index_);
  scene_.media.push_back(std::move(medium));
  return Id<Medium>{static_cast<std::uint32_t>(scene_.media.size() - 1)};
}

}  // namespace vitrail::gltf
