// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/textures.h"

#include <fmt/format.h>

#include <cmath>

#include "importers/gltf/read/extension_values.h"

namespace vitrail::gltf {

namespace {

constexpr const char* transform_name = "KHR_texture_transform";

std::array<double, 2> pair(const tinygltf::Value& object, const char* name, std::array<double, 2> otherwise) {
  if (!object.Has(name)) return otherwise;
  const tinygltf::Value& list = object.Get(name);
  if (!list.IsArray() || list.ArrayLen() != 2 || !list.Get(0).IsNumber() || !list.Get(1).IsNumber())
    return otherwise;
  return {list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble()};
}

// glTF's (0,0) is the upper left corner of the image, the Scene's the lower left one. The transform scales,
// turns and moves (u,v), in this order.
UvMapping mapping_of(const tinygltf::TextureInfo& info) {
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double rotation = 0;
  if (const tinygltf::Value* t = extension(info.extensions, transform_name)) {
    offset = pair(*t, "offset", offset), scale = pair(*t, "scale", scale);
    rotation = number(*t, "rotation", 0);
  }
  const double c = std::cos(rotation), s = std::sin(rotation);
  const auto f = [](double v) { return static_cast<float>(v); };
  return {f(scale[0] * c), f(scale[1] * s),  f(offset[0]),
          f(scale[0] * s), f(-scale[1] * c), f(1 - offset[1])};
}

Wrap wrap_of(int wrap) {
  return wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
         : wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                         : Wrap::repeat;
}

const char* name_of(Wrap wrap) {
  return wrap == Wrap::clamp ? "clamped" : wrap == Wrap::mirror ? "mirrored" : "repeated";
}

}  // namespace

int Textures::uv_set_of(const tinygltf::TextureInfo& info) {
  const tinygltf::Value* t = extension(info.extensions, transform_name);
  const int set = t ? index(*t, "texCoord") : -1;
  return set >= 0 ? set : info.texCoord;
}

void Textures::note(const std::string& what, int material) {
  const SourceLocation place = document_.place("materials", material);
  diagnostics_.push_back({Fidelity::approximated, what, place, place, RecordKind::texture});
}

ImageTexture Textures::image(const tinygltf::TextureInfo& info, const TextureUse& use, int material,
                             int uv_set) {
  const tinygltf::Model& model = document_.model();
  const auto& texture = document_.element(model.textures, info.index, "textures", "materials", material);
  int source = texture.source;
  if (const tinygltf::Value* webp = extension(texture.extensions, "EXT_texture_webp"))
    source = index(*webp, "source");
  if (source < 0) {
    const bool basis = texture.extensions.contains("KHR_texture_basisu");
    document_.fail("textures", info.index,
                   basis ? "its image is KTX 2 alone (KHR_texture_basisu): export it as PNG or JPEG"
                         : "it has no image");
  }
  document_.element(model.images, source, "images", "textures", info.index);
  ImageTexture image;
  image.filename = document_.image_file(source);
  image.mapping = mapping_of(info);
  image.encoding = use.encoding, image.number = use.number, image.scale = use.scale;
  if (texture.sampler >= 0) {
    const auto& sampler =
        document_.element(model.samplers, texture.sampler, "samplers", "textures", info.index);
    image.wrap = wrap_of(sampler.wrapS);
    if (sampler.wrapT != sampler.wrapS)
      note(fmt::format("textures[{}] is {} along u and {} along v: it is {} along both", info.index,
                       name_of(image.wrap), name_of(wrap_of(sampler.wrapT)), name_of(image.wrap)),
           material);
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) image.filter = TextureFilter::nearest;
  }
  if (const int set = uv_set_of(info); set != uv_set)
    note(fmt::format(
             "textures[{}] goes by TEXCOORD_{}: it is laid out by TEXCOORD_{}, as the material's others are",
             info.index, set, uv_set),
         material);
  return image;
}

Id<Texture> Textures::color(const tinygltf::TextureInfo& info, TextureUse use, int material, int uv_set) {
  return add(image(info, use, material, uv_set), false, material);
}

Id<Texture> Textures::number(const tinygltf::TextureInfo& info, TextureUse use, int material, int uv_set) {
  return add(image(info, use, material, uv_set), true, material);
}

Id<Texture> Textures::add(TextureModel model, bool is_float, int material) {
  const Texture wanted{std::move(model), is_float, "", document_.origin("materials", material)};
  const auto [begin, end] = of_material_.equal_range(material);
  for (auto known = begin; known != end; ++known)
    if (scene_.textures[known->second.value] == wanted) return known->second;
  const Id<Texture> id{static_cast<std::uint32_t>(scene_.textures.size())};
  scene_.textures.push_back(wanted);
  of_material_.emplace(material, id);
  return id;
}

}  // namespace vitrail::gltf
