// SPDX-License-Identifier: Apache-2.0
// Pictures adds the images of a written glTF: files as they are where they are PNG or JPEG and mean the same
// there, else new PNG of 8 bits.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "importers/gltf/write/binary.h"
#include "importers/writing/conversion_notes.h"
#include "scene/records/texture.h"

namespace vitrail::gltf {

// It is one channel of a composed image: a number of a texture, a channel of its colours, or a constant.
struct Channel {
  const ImageTexture* texture = nullptr;
  int of_color = -1;  // 0 to 2; −1: the texture's number
  float constant = 1;
};

class Pictures {
 public:
  Pictures(tinygltf::Model& model, Binary& binary, ConversionNotes& notes)
      : model_(model), binary_(binary), notes_(notes) {}

  // Adds the file's colours, or its data where it is `linear`, without the texture's scale.
  tinygltf::TextureInfo colors(const ImageTexture& texture, bool linear);
  // Adds a PNG of three or four channels, laid out as the first texture; the first three are encoded as sRGB
  // where they are `colors`.
  tinygltf::TextureInfo composed(const std::vector<Channel>& channels, bool colors);

 private:
  tinygltf::TextureInfo info(int image, const ImageTexture& like);
  int image_of_file(const std::string& file);
  int image_of_bytes(const std::vector<std::byte>& bytes, const char* kind);

  tinygltf::Model& model_;
  Binary& binary_;
  ConversionNotes& notes_;
  std::map<std::string, int> files_, composed_;
};

}  // namespace vitrail::gltf
