// SPDX-License-Identifier: Apache-2.0
// Each model of the Scene as a material of glTF.
#include <fmt/format.h>

#include <cmath>

#include "importers/gltf/write/values.h"
#include "importers/gltf/write/write_materials.h"
#include "importers/writing/coat_albedo.h"
#include "importers/writing/export_colors.h"
#include "scene/models/normal_map.h"

namespace vitrail::gltf {

void MaterialWriter::put(Id<Material> id) {
  const Material& material = scene_.materials.at(id.value);
  notes_.begin(RecordKind::material, material.origin);
  std::visit([this](const auto& model) { put(model); }, material.model);
  notes_.begin(RecordKind::material, material.origin);
  if (material.displacement) notes_.dropped("displacement: glTF has normal maps alone");
  if (!material.normal_map) return;
  if (const auto map = normal_map_of(scene_.textures, *material.normal_map)) {
    const auto& image = std::get<ImageTexture>(scene_.textures[map->image.value].model);
    const tinygltf::TextureInfo info = pictures_.colors(image, true);
    out_.normalTexture.index = info.index, out_.normalTexture.extensions = info.extensions;
    out_.normalTexture.scale = static_cast<double>(map->factors[0]);
    if (map->factors[1] != map->factors[0])
      notes_.approximated(
          fmt::format("normal map: its second number is as steep as its first, {:g} times for {:g}",
                      map->factors[0], map->factors[1]));
  } else {
    notes_.dropped("normal map that is no image");
  }
}

// A dielectric that reflects nothing.
void MaterialWriter::lambert() {
  out_.pbrMetallicRoughness.roughnessFactor = 1;
  extension("KHR_materials_specular")["specularFactor"] = tinygltf::Value(0.0);
}

void MaterialWriter::put(const DiffuseMaterial& m) {
  base(m.reflectance);
  lambert();
  if (m.sigma_deg != FloatParameter{0.0f}) notes_.approximated("Oren and Nayar's reflection: Lambert's");
}

void MaterialWriter::glass(const Spectrum& eta, const Spectrum& outside, const SpectrumParameter& tint) {
  base(tint);
  const double n = index_of_refraction(outside);
  index(n > 0 ? index_of_refraction(eta) / n : index_of_refraction(eta));
  if (!is_constant(eta)) notes_.approximated("dispersion: the index at 587.6 nm");
}

void MaterialWriter::put(const DielectricMaterial& m) {
  glass(m.eta, m.exterior_eta, m.transmittance_factor);
  if (m.reflectance_factor != SpectrumParameter{ConstantSpectrum{1}}) notes_.dropped("factor of reflection");
  roughness(m.roughness);
  transmit(1, true);
}

void MaterialWriter::put(const ThinDielectricMaterial& m) {
  glass(m.eta, m.exterior_eta, m.transmittance_factor);
  if (m.reflectance_factor != SpectrumParameter{ConstantSpectrum{1}}) notes_.dropped("factor of reflection");
  out_.pbrMetallicRoughness.roughnessFactor = 0;
  transmit(1, false);
}

void MaterialWriter::metal(const Metal& metal, const Roughness& rough) {
  if (const auto* normal = std::get_if<NormalReflectance>(&metal)) {
    base(normal->reflectance);
  } else {
    if (std::holds_alternative<ComplexIndex>(metal))
      notes_.approximated("conductor: by its colour at normal incidence");
    const RGB c = normal_reflectance_rgb(metal);
    out_.pbrMetallicRoughness.baseColorFactor = {c.r, c.g, c.b, 1};
  }
  out_.pbrMetallicRoughness.metallicFactor = 1;
  roughness(rough);
}

void MaterialWriter::put(const ConductorMaterial& m) {
  metal(m.metal, m.roughness);
  if (m.reflectance_factor != SpectrumParameter{ConstantSpectrum{1}})
    notes_.dropped("factor of a conductor's reflection");
}

void MaterialWriter::put(const CoatedConductorMaterial& m) {
  metal(m.metal, m.conductor_roughness);
  notes_.approximated("coated conductor: clearcoat's layer");
  extension("KHR_materials_clearcoat")["clearcoatFactor"] = tinygltf::Value(1.0);
  const auto* alpha = std::get_if<float>(&m.interface_roughness.alpha_u);
  if (alpha && *alpha > 0)
    extension("KHR_materials_clearcoat")["clearcoatRoughnessFactor"] =
        tinygltf::Value(short_number(std::sqrt(std::min(*alpha, 1.0f))));
}

void MaterialWriter::put(const PlasticMaterial& m) {
  base(m.diffuse_reflectance);
  index(static_cast<double>(m.exterior_eta > 0 ? m.eta / m.exterior_eta : m.eta));
  roughness(m.roughness);
  notes_.approximated("plastic: glTF's dielectric, without light that goes back and forth below the surface");
  const Color specular = color(m.specular_reflectance, "specular reflection");
  if (specular.factor != RGB{1, 1, 1})
    extension("KHR_materials_specular")["specularColorFactor"] = list(specular.factor);
}

void MaterialWriter::put(const CoatedDiffuseMaterial& m) {
  base(m.reflectance);
  index(index_of_refraction(m.eta));
  roughness(m.roughness);
  notes_.approximated(
      "coated diffuse: glTF's dielectric, without light that goes back and forth below the surface");
}

void MaterialWriter::put(const DiffuseTransmissionMaterial& m) {
  notes_.approximated("diffuse transmission: reflection alone");
  base(m.reflectance);
  lambert();
}

void MaterialWriter::put(const PrincipledMaterial& m) {
  base(m.base_color);
  roughness_and_metal(m.roughness, m.metallic);
  index(static_cast<double>(m.eta));
  if (!m.below && has_base(m))
    notes_.approximated("principled material: in glTF its base is 3 to 7 % darker, 20 % at grazing angles");
  const auto is_zero = [](const FloatParameter& p) { return p == FloatParameter{0.0f}; };
  if (!is_zero(m.spec_trans)) transmit(number(m.spec_trans, "transmission"), !m.thin);
  if (!is_zero(m.clearcoat)) {
    auto& coat = extension("KHR_materials_clearcoat");
    coat["clearcoatFactor"] = tinygltf::Value(std::clamp(number(m.clearcoat, "clearcoat"), 0.0, 1.0));
    const double width = 0.1 - 0.099 * number(m.clearcoat_gloss, "gloss of the clearcoat");  // Burley's
    coat["clearcoatRoughnessFactor"] =
        tinygltf::Value(short_number(static_cast<float>(std::sqrt(std::max(width, 0.0)))));
    notes_.approximated("clearcoat: glTF's reflects four times as much as Burley's");
  }
  if (!is_zero(m.sheen)) {
    const double s = number(m.sheen, "sheen");
    extension("KHR_materials_sheen")["sheenColorFactor"] = list({s, s, s});
    notes_.approximated("sheen: glTF's");
  }
  if (!is_zero(m.anisotropic)) {
    // Widths of α/a and α·a, a² = 1 − 0.9·anisotropic, as lerp(α', 1, s²) and α'.
    const double a = std::sqrt(1 - 0.9 * number(m.anisotropic, "anisotropy")),
                 r = out_.pbrMetallicRoughness.roughnessFactor;
    const double across = r * r * a, along = std::min(r * r / a, 1.0);
    out_.pbrMetallicRoughness.roughnessFactor = std::sqrt(across);
    extension("KHR_materials_anisotropy")["anisotropyStrength"] =
        tinygltf::Value(across < 1 ? std::sqrt(std::max(along - across, 0.0) / (1 - across)) : 0.0);
  }
  for (const auto& [parameter, what] : {std::pair{&m.spec_tint, "tint of the reflection"},
                                        {&m.sheen_tint, "tint of the sheen"},
                                        {&m.flatness, "flatness"},
                                        {&m.diff_trans, "diffuse transmission"}})
    if (!is_zero(*parameter)) notes_.dropped(fmt::format("{} of a principled material", what));
}

void MaterialWriter::grey(const char* what, double value) {
  notes_.approximated(fmt::format("{}: diffuse, {}", what, value));
  out_.pbrMetallicRoughness.baseColorFactor = {value, value, value, 1};
  lambert();
}

void MaterialWriter::put(const SubsurfaceMaterial& m) {
  const auto* effective = std::get_if<SubsurfaceMaterial::Effective>(&m.interior);
  if (!effective) return grey("subsurface scattering", 0.5);
  notes_.approximated("subsurface scattering: diffuse, of its reflectance");
  base(effective->reflectance);
  lambert();
}

void MaterialWriter::put(const HairMaterial& m) {
  if (!m.color) return grey("hair", 0.2);
  notes_.approximated("hair: diffuse, of its colour");
  base(*m.color);
  lambert();
}

void MaterialWriter::put(const InterfaceMaterial&) {
  if (interior_) notes_.dropped("a medium without a surface: glTF has none");
  opacity_ = 0.0f;
}

void MaterialWriter::put(const BlendMaterial& m) {
  const bool second = number(m.amount, "amount of a blend") > 0.5;
  notes_.approximated(fmt::format("blend of materials: the {} alone", second ? "second" : "first"));
  put(second ? m.second : m.first);
}

void MaterialWriter::put(const TwoSidedMaterial& m) {
  notes_.approximated("two-sided material: its front");
  put(m.front);
}

// What is there of the shape is multiplied by what its material leaves of it.
void MaterialWriter::put(const MaskMaterial& m) {
  const auto *own = std::get_if<float>(&m.opacity), *of_shape = std::get_if<float>(&opacity_);
  if (own && of_shape) {
    opacity_ = *own * *of_shape;
  } else if (opacity_ == FloatParameter{1.0f}) {
    opacity_ = m.opacity;
  } else if (m.opacity != FloatParameter{1.0f}) {
    notes_.approximated("two opacities of which one is a texture: the shape's alone");
  }
  put(m.material);
}

}  // namespace vitrail::gltf
