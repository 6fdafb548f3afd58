// SPDX-License-Identifier: Apache-2.0
// What speaks OpenImageIO. With the 260 libraries that hang on it, it takes 0.3 s and 130 MB to load, so it
// is a module of its own (openimageio.cpp), which image_files.cpp loads with the first image.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "images/image_files.h"

namespace vitrail {

// All return what went wrong, or nothing.
struct ImageCodec {
  // Without `image`, the layout alone.
  std::string (*read)(const std::string& file, ImageLayout& layout, Image* image);
  // What `visit` throws passes through.
  std::string (*read_rows)(const std::string& file, ImageLayout& layout,
                           const std::function<void(Image)>& visit);
  // The bytes of an EXR file.
  std::string (*encode_exr)(const Image& image, std::vector<std::byte>& bytes);
};

inline constexpr const char* image_codec_module = "vitrail-openimageio.so";
inline constexpr const char* image_codec_symbol = "vitrail_image_codec";

}  // namespace vitrail
