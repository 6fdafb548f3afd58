// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/write/write_materials.h"

#include <fmt/format.h>

#include <cmath>

#include "importers/gltf/write/values.h"
#include "importers/images/converted_images.h"
#include "importers/writing/alike_lights.h"
#include "importers/writing/export_colors.h"
#include "scene/records/curve_uses.h"

namespace vitrail::gltf {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

RGB held(RGB c) {
  for (double* v : {&c.r, &c.g, &c.b}) *v = std::clamp(short_number(static_cast<float>(*v)), 0.0, 1.0);
  return c;
}

// The ramp that stands for a cutoff (read/material_builder.cpp).
std::optional<double> cutoff_of(const Texture& texture) {
  const auto* mix = std::get_if<MixTexture>(&texture.model);
  const auto constant = [](const SpectrumParameter& p) -> std::optional<double> {
    const auto* spectrum = std::get_if<Spectrum>(&p);
    const auto* value = spectrum ? std::get_if<ConstantSpectrum>(spectrum) : nullptr;
    return value ? std::optional(static_cast<double>(value->value)) : std::nullopt;
  };
  if (!mix) return {};
  const auto first = constant(mix->first), second = constant(mix->second);
  constexpr double least_steepness = 64;
  if (!first || !second || *second - *first < least_steepness) return {};
  return (1 - *first) / (*second - *first);
}

}  // namespace

// Of those that are written with the material, the first that shines alike.
std::uint32_t MaterialWriter::known_light(const Shape& shape) const {
  if (!shape.area_light) return none;
  const std::uint32_t material = shape.material.value;
  for (auto at = known_.lower_bound({material, 0, {}, 0}); at != known_.end(); ++at) {
    const auto& [its_material, its_light, its_opacity, its_interior] = at->first;
    if (its_material != material) break;
    if (its_light != none &&
        shine_alike(area_lights_.at(its_light), area_lights_.at(shape.area_light->value)))
      return its_light;
  }
  return shape.area_light->value;
}

int MaterialWriter::write(const Shape& shape) {
  const Key key{shape.material.value, known_light(shape), opacity_key(shape.opacity),
                shape.interior ? shape.interior->value : none};
  const auto [known, is_new] = known_.try_emplace(key, 0);
  if (!is_new) return known->second;
  out_ = {}, extensions_.clear(), attribute_.clear(), base_ = {};
  out_.pbrMetallicRoughness.metallicFactor = 0;
  opacity_ = shape.opacity, interior_ = shape.interior;
  if (const auto* of_curve = std::get_if<float>(&shape.opacity); of_curve && is_of_curves(scene_, shape))
    opacity_ = opacity_of_wall(*of_curve);
  const Material& material = scene_.materials.at(shape.material.value);
  out_.name = material.name;
  out_.doubleSided = material.two_sided;
  notes_.begin(RecordKind::material, material.origin);
  put(shape.material);
  opacity(opacity_);
  if (shape.area_light) light(area_lights_.at(shape.area_light->value));
  for (auto& [name, object] : extensions_) {
    out_.extensions[name] = tinygltf::Value(object);
    use(model_, name);
  }
  model_.materials.push_back(out_);
  known->second = static_cast<int>(model_.materials.size()) - 1;
  attributes_[known->second] = attribute_;
  return known->second;
}

tinygltf::Value::Object& MaterialWriter::extension(const char* name) { return extensions_[name]; }

// ---- Values

MaterialWriter::Color MaterialWriter::color(const SpectrumParameter& parameter, const char* what) {
  if (const auto* spectrum = std::get_if<Spectrum>(&parameter)) {
    if (!is_rgb(*spectrum)) notes_.approximated("spectrum: its colour in linear sRGB");
    return {factor_rgb(*spectrum), nullptr};
  }
  const Id<Texture> id = std::get<Id<Texture>>(parameter);
  if (const auto tinted = tinted_image(scene_, id); tinted && !tinted->is_number) {
    const double scale = static_cast<double>(tinted->image.scale);
    const RGB& c = tinted->tint;
    // Of the scene, so that it lasts.
    for (const Texture& t : scene_.textures)
      if (const auto* image = std::get_if<ImageTexture>(&t.model); image && *image == tinted->image)
        return {{c.r * scale, c.g * scale, c.b * scale}, image};
  }
  if (const auto* attribute = std::get_if<MeshAttributeTexture>(&scene_.textures.at(id.value).model)) {
    attribute_ = attribute->name;
    const double s = static_cast<double>(attribute->scale);
    return {{s, s, s}, nullptr};
  }
  if (const BakedTexture* baked = baked_.bake(id)) {
    notes_.approximated(baked->note);
    const double s = static_cast<double>(baked->image.scale);
    return {{s, s, s}, &baked->image};
  }
  if (const auto* product = std::get_if<ProductTexture>(&scene_.textures.at(id.value).model)) {
    const Color a = color(product->first, what), b = color(product->second, what);
    if (a.image && b.image)
      notes_.approximated(fmt::format("a product of images for the {}: the first", what));
    return {{a.factor.r * b.factor.r, a.factor.g * b.factor.g, a.factor.b * b.factor.b},
            a.image ? a.image : b.image};
  }
  notes_.approximated(fmt::format("texture of the {} that is no image: 0.5", what));
  return {{0.5, 0.5, 0.5}, nullptr};
}

const ImageTexture* MaterialWriter::image_of(const FloatParameter& parameter) const {
  const auto* id = std::get_if<Id<Texture>>(&parameter);
  return id ? std::get_if<ImageTexture>(&scene_.textures.at(id->value).model) : nullptr;
}

const ImageTexture* MaterialWriter::image_of_numbers(const FloatParameter& parameter) {
  const auto* id = std::get_if<Id<Texture>>(&parameter);
  if (!id || image_of(parameter)) return image_of(parameter);
  const BakedTexture* baked = baked_.bake(*id);
  if (baked) notes_.approximated(baked->note);
  return baked ? &baked->image : nullptr;
}

double MaterialWriter::number(const FloatParameter& parameter, const char* what) {
  if (const auto* value = std::get_if<float>(&parameter)) return short_number(*value);
  notes_.approximated(fmt::format("texture of the {}: 0.5", what));
  return 0.5;
}

void MaterialWriter::base(const SpectrumParameter& parameter) {
  base_ = color(parameter, "base colour");
  const RGB c = held(base_.factor);
  if (std::max({base_.factor.r, base_.factor.g, base_.factor.b}) > 1 + 1e-6)
    notes_.approximated("a colour above 1: it is held there");
  out_.pbrMetallicRoughness.baseColorFactor = {c.r, c.g, c.b, 1};
  if (base_.image) out_.pbrMetallicRoughness.baseColorTexture = pictures_.colors(*base_.image, false);
}

void MaterialWriter::roughness(const Roughness& r) {
  if (r.alpha_u != r.alpha_v) notes_.approximated("anisotropic roughness: along u");
  if (r.distribution == Roughness::Distribution::beckmann && r.alpha_u != FloatParameter{0.0f})
    notes_.approximated("Beckmann's microfacets: GGX of the same width");
  const auto* alpha = std::get_if<float>(&r.alpha_u);
  if (!alpha) notes_.approximated("texture of the roughness: 0.5");
  out_.pbrMetallicRoughness.roughnessFactor =
      alpha ? short_number(static_cast<float>(std::sqrt(std::clamp(static_cast<double>(*alpha), 0.0, 1.0))))
            : 0.5;
}

// Both from one image, roughness from its green and metal from its blue channel.
void MaterialWriter::roughness_and_metal(const FloatParameter& rough, const FloatParameter& metallic) {
  auto& pbr = out_.pbrMetallicRoughness;
  const ImageTexture *r = image_of_numbers(rough), *m = image_of_numbers(metallic);
  const bool as_they_are = (!r || r->number == ImageNumber::green) &&
                           (!m || m->number == ImageNumber::blue) &&
                           (!r || !m || (r->filename == m->filename && r->mapping == m->mapping));
  pbr.roughnessFactor = r ? 1 : number(rough, "roughness");
  pbr.metallicFactor = m ? 1 : number(metallic, "metal");
  if (!r && !m) return;
  if (as_they_are) {
    if (r) pbr.roughnessFactor = std::clamp(short_number(r->scale), 0.0, 1.0);
    if (m) pbr.metallicFactor = std::clamp(short_number(m->scale), 0.0, 1.0);
    pbr.metallicRoughnessTexture = pictures_.colors(r ? *r : *m, true);
    return;
  }
  pbr.metallicRoughnessTexture = pictures_.composed({{nullptr, -1, 0}, {r, -1, 1}, {m, -1, 1}}, false);
}

void MaterialWriter::index(double eta) {
  if (eta != 1.5)
    extension("KHR_materials_ior")["ior"] = tinygltf::Value(short_number(static_cast<float>(eta)));
}

// The way through a solid is in its mesh: any thickness above 0 says that there is one.
void MaterialWriter::transmit(double amount, bool solid) {
  extension("KHR_materials_transmission")["transmissionFactor"] = tinygltf::Value(amount);
  if (!solid) return;
  auto& volume = extension("KHR_materials_volume");
  volume["thicknessFactor"] = tinygltf::Value(1.0);
  if (!interior_) return;
  const Medium& medium = scene_.media.at(interior_->value);
  const auto* c = std::get_if<AbsorptionScattering>(&medium.coefficients);
  const auto* absorbed = c ? std::get_if<Spectrum>(&c->sigma_a) : nullptr;
  const auto* scattered = c ? std::get_if<Spectrum>(&c->sigma_s) : nullptr;
  if (!absorbed || !scattered || *scattered != Spectrum{ConstantSpectrum{0}} || medium.density.index() != 0) {
    notes_.dropped("a medium that does more than absorb", medium.origin, RecordKind::medium);
    if (!absorbed) return;
  }
  const RGB sigma = factor_rgb(*absorbed);
  const double most = std::max({sigma.r, sigma.g, sigma.b}) * static_cast<double>(medium.scale);
  if (most <= 0) return;
  // What is left after the distance in which the colour that is absorbed most falls to a quarter.
  const double distance = std::log(4) / most;
  std::vector<SpectrumSample> left;
  for (int i = 0; i < table_size; ++i) {
    const double nm = lambda_min_nm + i;
    const double s = std::max(evaluate(*absorbed, nm), 0.0) * static_cast<double>(medium.scale);
    left.push_back({nm, std::exp(-s * distance)});
  }
  volume["attenuationDistance"] = tinygltf::Value(distance);
  volume["attenuationColor"] = list(factor_rgb(tabulate(left, true)));
}

void MaterialWriter::opacity(const FloatParameter& parameter) {
  FloatParameter alpha = parameter;
  if (const auto* id = std::get_if<Id<Texture>>(&parameter)) {
    const Texture& texture = scene_.textures.at(id->value);
    if (const auto cutoff = cutoff_of(texture)) {
      out_.alphaMode = "MASK";
      out_.alphaCutoff = short_number(static_cast<float>(*cutoff));
      alpha = std::get<MixTexture>(texture.model).amount;
    }
  } else if (parameter == FloatParameter{1.0f}) {
    return;
  }
  if (out_.alphaMode == "OPAQUE") out_.alphaMode = "BLEND";
  auto& pbr = out_.pbrMetallicRoughness;
  if (pbr.baseColorFactor.size() < 4) pbr.baseColorFactor = {1, 1, 1, 1};
  const ImageTexture* image = image_of_numbers(alpha);
  if (!image) {
    pbr.baseColorFactor[3] = number(alpha, "opacity");
    return;
  }
  const ImageTexture* color = base_.image;
  if (color && color->filename == image->filename && image->number == ImageNumber::alpha &&
      color->mapping == image->mapping && !image->invert && !color->invert) {
    pbr.baseColorFactor[3] = std::clamp(short_number(image->scale), 0.0, 1.0);
    return;
  }
  ImageTexture unscaled = color ? *color : *image;
  unscaled.scale = 1;
  const ImageTexture* colors = color ? &unscaled : nullptr;
  pbr.baseColorTexture =
      pictures_.composed({{colors, 0, 1}, {colors, 1, 1}, {colors, 2, 1}, {image, -1, 1}}, true);
}

void MaterialWriter::light(const AreaLight& light) {
  notes_.begin(RecordKind::area_light, light.origin);
  if (light.directional) notes_.approximated("light along the normal alone: in all directions");
  if (light.two_sided) out_.doubleSided = true;
  Color shape;
  if (const auto* spectrum = std::get_if<Spectrum>(&light.radiance)) {
    if (!is_rgb(*spectrum)) notes_.approximated("spectrum of a light: its colour in linear sRGB");
    shape.factor = emission_rgb(*spectrum);
  } else {
    shape = color(light.radiance, "light");
  }
  const auto scale = static_cast<double>(light.scale);
  const RGB c{shape.factor.r * scale, shape.factor.g * scale, shape.factor.b * scale};
  const double most = std::max({c.r, c.g, c.b});
  if (most <= 0) return;
  const double strength = most > 1 ? most : 1;
  const RGB factor = held({c.r / strength, c.g / strength, c.b / strength});
  out_.emissiveFactor = {factor.r, factor.g, factor.b};
  if (strength != 1)
    extension("KHR_materials_emissive_strength")["emissiveStrength"] =
        tinygltf::Value(short_number(static_cast<float>(strength)));
  if (shape.image) out_.emissiveTexture = pictures_.colors(*shape.image, false);
}

}  // namespace vitrail::gltf
