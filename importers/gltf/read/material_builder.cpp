// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/material_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/gltf/read/extension_values.h"
#include "importers/gltf/units.h"
#include "scene/models/normal_map.h"

namespace vitrail::gltf {

namespace {

// glTF's default: white, metallic and rough as its factors' defaults are.
const tinygltf::Material default_material;

bool is_one(RGB c) { return c == RGB{1, 1, 1}; }
bool is_grey(RGB c) { return c.r == c.g && c.g == c.b; }
double greatest(RGB c) { return std::max({c.r, c.g, c.b}); }

RGB rgb_of(const std::vector<double>& list, RGB otherwise) {
  return list.size() >= 3 ? RGB{list[0], list[1], list[2]} : otherwise;
}

bool is_constant(const FloatParameter& parameter, float value) { return parameter == FloatParameter{value}; }

}  // namespace

MaterialBuilder::MaterialBuilder(const Document& document, int index, int color_channels, Scene& scene,
                                 Diagnostics& diagnostics, Textures& textures)
    : document_(document),
      m_(index < 0 ? default_material : document.model().materials[static_cast<std::size_t>(index)]),
      index_(index),
      color_channels_(color_channels),
      scene_(scene),
      diagnostics_(diagnostics),
      textures_(textures),
      uv_set_(uv_set()) {}

Surface MaterialBuilder::build() {
  Surface surface;
  surface.uv_set = uv_set_;
  Material material;
  material.model = model();
  material.name = m_.name;
  material.origin = document_.origin("materials", index_);
  if (m_.normalTexture.index >= 0) {
    tinygltf::TextureInfo info;
    info.index = m_.normalTexture.index, info.texCoord = m_.normalTexture.texCoord;
    info.extensions = m_.normalTexture.extensions;
    material.normal_map = textures_.color(info, {Encoding::linear}, index_, uv_set_);
    if (const auto steepness = static_cast<float>(m_.normalTexture.scale); steepness != 1)
      material.normal_map =
          textures_.add(scaled_normal_map({*material.normal_map, {steepness, steepness, 1}}), false, index_);
  }
  if (m_.occlusionTexture.index >= 0)
    note(Fidelity::dropped, "occlusionTexture: paths find out what is dark");
  light(surface);
  surface.has_color_map = m_.pbrMetallicRoughness.baseColorTexture.index >= 0;
  surface.opacity = opacity();
  surface.interior = interior();
  scene_.materials.push_back(std::move(material));
  surface.material = {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  return surface;
}

void MaterialBuilder::note(Fidelity fidelity, const std::string& what) const {
  const SourceLocation place = document_.place("materials", index_);
  diagnostics_.push_back({fidelity, what, place, place, RecordKind::material});
}

double MaterialBuilder::held(const char* name, double value, double low, double high) const {
  if (value >= low && value <= high) return value;
  approximated(fmt::format("{} of {:g} counts as {:g}", name, value, value > high ? high : low));
  return value > high ? high : low;
}

const tinygltf::Value* MaterialBuilder::extension(const char* name) const {
  return gltf::extension(m_.extensions, name);
}

// That of the base colour, else of the first texture.
int MaterialBuilder::uv_set() const {
  const auto& pbr = m_.pbrMetallicRoughness;
  if (pbr.baseColorTexture.index >= 0) return Textures::uv_set_of(pbr.baseColorTexture);
  if (pbr.metallicRoughnessTexture.index >= 0) return Textures::uv_set_of(pbr.metallicRoughnessTexture);
  if (m_.emissiveTexture.index >= 0) return Textures::uv_set_of(m_.emissiveTexture);
  if (m_.normalTexture.index >= 0) return m_.normalTexture.texCoord;
  return 0;
}

// ---- Values

FloatParameter MaterialBuilder::number(const tinygltf::TextureInfo* map, double factor,
                                       ImageNumber channel) const {
  const auto value = static_cast<float>(factor);
  if (!map || map->index < 0) return value;
  return textures_.number(*map, {Encoding::linear, channel, value}, index_, uv_set_);
}

SpectrumParameter MaterialBuilder::tinted(const tinygltf::TextureInfo& map, Encoding encoding,
                                          RGB factor) const {
  if (is_grey(factor))
    return textures_.color(map, {encoding, {}, static_cast<float>(factor.r)}, index_, uv_set_);
  const Id<Texture> image = textures_.color(map, {encoding}, index_, uv_set_);
  return textures_.add(ProductTexture{Spectrum{unbounded_from_rgb(factor)}, image}, false, index_);
}

SpectrumParameter MaterialBuilder::base_color() const {
  const auto& pbr = m_.pbrMetallicRoughness;
  RGB factor = rgb_of(pbr.baseColorFactor, {1, 1, 1});
  for (double* c : {&factor.r, &factor.g, &factor.b}) *c = held("baseColorFactor", *c, 0, 1);
  SpectrumParameter color = Spectrum{reflectance_from_rgb(factor)};
  if (pbr.baseColorTexture.index >= 0) color = tinted(pbr.baseColorTexture, Encoding::srgb, factor);
  if (color_channels_ == 0) return color;
  const Id<Texture> vertices = textures_.add(MeshAttributeTexture{vertex_color}, false, index_);
  if (pbr.baseColorTexture.index < 0 && is_one(factor)) return vertices;
  return textures_.add(ProductTexture{color, vertices}, false, index_);
}

FloatParameter MaterialBuilder::alpha() const {
  const auto& pbr = m_.pbrMetallicRoughness;
  const double factor =
      held("baseColorFactor's alpha", pbr.baseColorFactor.size() > 3 ? pbr.baseColorFactor[3] : 1, 0, 1);
  const FloatParameter image = number(&pbr.baseColorTexture, factor, ImageNumber::alpha);
  if (color_channels_ < 4) return image;
  const Id<Texture> vertices = textures_.add(MeshAttributeTexture{vertex_alpha}, true, index_);
  if (is_constant(image, 1)) return vertices;
  SpectrumParameter first;
  if (const auto* constant = std::get_if<float>(&image))
    first = Spectrum{ConstantSpectrum{*constant}};
  else
    first = std::get<Id<Texture>>(image);
  return textures_.add(ProductTexture{first, vertices}, true, index_);
}

// MASK is a ramp so steep that it is a step: 1 at the cutoff, 0 by 1/1024 below.
FloatParameter MaterialBuilder::opacity() const {
  if (m_.alphaMode == "BLEND") return alpha();
  if (m_.alphaMode != "MASK") return 1.0f;
  constexpr double steepness = 1024;
  const double cutoff = m_.alphaCutoff;
  const FloatParameter a = alpha();
  if (const auto* constant = std::get_if<float>(&a))
    return static_cast<double>(*constant) >= cutoff ? 1.0f : 0.0f;
  const auto at = [&](double value) {
    return Spectrum{ConstantSpectrum{static_cast<float>(1 + steepness * (value - cutoff))}};
  };
  return textures_.add(MixTexture{at(0), at(1), a}, true, index_);
}

void MaterialBuilder::light(Surface& surface) const {
  const bool unlit = extension("KHR_materials_unlit") != nullptr;
  const tinygltf::Value* strong = extension("KHR_materials_emissive_strength");
  const double strength = unlit ? 1 : strong ? gltf::number(*strong, "emissiveStrength", 1) : 1;
  RGB factor = unlit ? RGB{1, 1, 1} : rgb_of(m_.emissiveFactor, {0, 0, 0});
  if (std::min({factor.r, factor.g, factor.b}) < 0 || strength < 0) {
    approximated("negative emission counts as 0");
    factor = {std::max(factor.r, 0.0), std::max(factor.g, 0.0), std::max(factor.b, 0.0)};
  }
  if (greatest(factor) <= 0 || strength <= 0) return;
  AreaLight light;
  light.two_sided = m_.doubleSided;
  light.origin = document_.origin("materials", index_);
  SpectrumParameter shape = Spectrum{emission(factor, strength)};
  if (unlit) {
    shape = base_color();
    if (const auto* constant = std::get_if<Spectrum>(&shape)) {
      const auto* sigmoid = std::get_if<SigmoidSpectrum>(constant);
      shape = Spectrum{
          emission(sigmoid ? RGB{sigmoid->rgb[0], sigmoid->rgb[1], sigmoid->rgb[2]} : RGB{1, 1, 1}, 1)};
    }
  } else if (m_.emissiveTexture.index >= 0) {
    shape = tinted(m_.emissiveTexture, Encoding::srgb, factor);
  }
  light.radiance = shape;
  if (std::holds_alternative<Id<Texture>>(shape))
    light.scale = static_cast<float>(strength / shown_per_radiance);
  scene_.area_lights.push_back(std::move(light));
  surface.light = Id<AreaLight>{static_cast<std::uint32_t>(scene_.area_lights.size() - 1)};
}

}  // namespace vitrail::gltf
