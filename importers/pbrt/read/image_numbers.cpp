// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/image_numbers.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "scene/system/input_files.h"

namespace vitrail::pbrt {

namespace {

// By the colour type in the header of a PNG file (ISO/IEC 15948, 11.2.2).
bool is_rgba_png(const std::string& filename) {
  constexpr std::streamoff color_type = 25;
  constexpr int truecolor_with_alpha = 6;
  std::ifstream file = open_input(filename);
  file.seekg(color_type);
  return file.get() == truecolor_with_alpha;
}

}  // namespace

ImageNumber number_taken(Version version, const std::string& filename, TextureFilter filter) {
  if (version == Version::v3) return ImageNumber::stored_luminance;
  if (filter == TextureFilter::nearest || filter == TextureFilter::anisotropic) return ImageNumber::red;
  const bool may_be_rgba =
      filename.ends_with(".exr") || (filename.ends_with(".png") && is_rgba_png(filename));
  return may_be_rgba ? ImageNumber::alpha_or_mean : ImageNumber::mean;
}

bool takes_encoding(const std::string& filename) {
  std::string extension = std::filesystem::path(filename).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ".png";
}

Primaries primaries_taken(Version version, bool is_float) {
  return version == Version::v3 || is_float ? Primaries::srgb : Primaries::named;
}

}  // namespace vitrail::pbrt
