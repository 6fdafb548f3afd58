// SPDX-License-Identifier: Apache-2.0
// An ImageCodec uses OpenImageIO and OpenColorIO. They need 260 libraries, 0.3 s and 130 MB to load, so the
// codec is a module of its own, which is loaded with the first image that needs it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "images/image_files.h"

namespace vitrail {

// A PictureFile is all that a file holds but its pixels. Those are interleaved, the top left one first.
struct PictureFile {
  struct Channel {
    std::string name;
    bool is_id = false;
  };
  // A matrix has 16 numbers, row by row.
  using Value = std::variant<int, float, std::string, std::array<float, 16>>;

  int width = 0, height = 0;
  int x = 0, y = 0, full_width = 0, full_height = 0;  // the place in a larger whole
  bool are_integers = false;                          // else floats, and 32-bit integers where they are ids
  int bits = 32;                                      // a channel
  std::vector<Channel> channels;
  std::vector<std::pair<std::string, Value>> attributes;
};

// A PictureSource is a file by its name, or the bytes of a file where there are any: `file` then is a name
// that ends in its kind.
struct PictureSource {
  std::string file;
  std::span<const std::byte> bytes{};
};

// All functions of an ImageCodec return what went wrong, or nothing.
struct ImageCodec {
  // Makes the library do what it does with the first file.
  void (*begin)();
  // It reads the layout alone where `image` is null.
  std::string (*read)(const PictureSource& source, ImageLayout& layout, Image* image);
  // Exceptions of `visit` pass through it.
  std::string (*read_rows)(const PictureSource& source, ImageLayout& layout,
                           const std::function<void(Image)>& visit);
  // It makes the bytes of an EXR file.
  std::string (*encode_exr)(const Image& image, std::vector<std::byte>& bytes);
  // It makes the bytes of a file in the format that the extension of `file` names.
  std::string (*encode_picture)(const std::string& file, const PictureFile& picture, const void* pixels,
                                std::vector<std::byte>& bytes);
  // It reads any picture and takes integers to [0,1]. The caller names the attributes, with the values that
  // count where the file has none.
  std::string (*decode_picture)(const std::string& file, PictureFile& picture, std::vector<float>& values);
  // It applies ACES' output transform 1.x to colours whose 3 × 3 matrix to XYZ is given row by row
  // (tone_map.h).
  std::string (*map_tones)(Image& rgb, const std::array<double, 9>& to_xyz);
};

inline constexpr const char* image_codec_module = "vitrail-openimageio.so";
inline constexpr const char* image_codec_symbol = "vitrail_image_codec";

// Loads the module. Throws MachineError where it cannot be loaded.
const ImageCodec& image_codec();

}  // namespace vitrail
