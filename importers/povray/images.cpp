// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <map>

#include "importers/mesh_files.h"
#include "importers/povray/pigments.h"

namespace vitrail::povray {

namespace {

std::string suffix_of(const std::string& filename) {
  std::string suffix = std::filesystem::path(filename).extension().string();
  std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  return suffix;
}

// By the header of a PNG file; the depth of others is taken as 8.
bool has_16_bits(const std::string& filename) {
  std::ifstream file(filename, std::ios::binary);
  constexpr std::streamoff depth = 24;
  file.seekg(depth);
  return file.get() == 16;
}

}  // namespace

std::optional<std::string> image_of(Context& context, const std::string& filename, Encoding encoding,
                                    float gamma, const Origin& origin) {
  static const std::map<std::string, std::string> kinds{
      {".png", "png"},   {".jpg", "jpeg"}, {".jpeg", "jpeg"}, {".tga", "tga"}, {".tif", "tiff"},
      {".tiff", "tiff"}, {".gif", "gif"},  {".bmp", "bmp"},   {".ppm", "ppm"}, {".pgm", "pgm"},
      {".iff", "iff"},   {".exr", "exr"},  {".hdr", "hdr"}};
  const std::string suffix = suffix_of(filename);
  const auto kind = kinds.find(suffix);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(filename, ignored)) {
    context.dropped(fmt::format("image {}: there is no such file; 0.5 is written", filename), origin);
    return {};
  }
  if (kind == kinds.end()) {
    context.dropped(fmt::format("image {}: POV-Ray 3.7 does not read this kind; 0.5 is written", filename),
                    origin);
    return {};
  }
  const bool is_linear_kind =
      suffix == ".exr" || suffix == ".hdr" || (suffix == ".png" && has_16_bits(filename));
  std::string text = fmt::format("{} {}", kind->second, quoted(relative_name(filename, context.directory)));
  if (encoding == Encoding::gamma) return text + fmt::format(" gamma {}", gamma);
  if (encoding == Encoding::linear || (encoding == Encoding::automatic && is_linear_kind))
    return text + " gamma 1.0";
  return text + " gamma srgb";
}

}  // namespace vitrail::povray
