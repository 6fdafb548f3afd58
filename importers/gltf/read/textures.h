// SPDX-License-Identifier: Apache-2.0
// Textures makes textures of the Scene from textureInfos.
#pragma once

#include <map>
#include <string>

#include "importers/gltf/read/document.h"

namespace vitrail::gltf {

// It says what a material takes from an image.
struct TextureUse {
  Encoding encoding = Encoding::linear;
  ImageNumber number = ImageNumber::mean;  // of numbers
  float scale = 1;
};

class Textures {
 public:
  Textures(const Document& document, Scene& scene, Diagnostics& diagnostics)
      : document_(document), scene_(scene), diagnostics_(diagnostics) {}

  // They add an image as a colour or as a number. `material` uses it, whose meshes have as (u,v) those of the
  // set `uv_set`.
  Id<Texture> color(const tinygltf::TextureInfo& info, TextureUse use, int material, int uv_set);
  Id<Texture> number(const tinygltf::TextureInfo& info, TextureUse use, int material, int uv_set);
  // Adds any texture, once.
  Id<Texture> add(TextureModel model, bool is_float, int material);

  // Returns the set of (u,v) of a textureInfo, as its KHR_texture_transform may have it.
  static int uv_set_of(const tinygltf::TextureInfo& info);

 private:
  ImageTexture image(const tinygltf::TextureInfo& info, const TextureUse& use, int material, int uv_set);
  void note(const std::string& what, int material);

  const Document& document_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  std::multimap<int, Id<Texture>> of_material_;
};

}  // namespace vitrail::gltf
