// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_images.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "importers/writing/jpeg_components.h"
#include "scene/system/input_files.h"

namespace vitrail::mitsuba_writer {

namespace {

// What Mitsuba makes of the texture's own file. Of three channels its spectral variants make numbers only if
// it is raw, which for floats is the same.
ImageTexture taken_by_mitsuba(const ImageTexture& texture, bool raw) {
  ImageTexture taken = texture;
  taken.encoding = raw ? Encoding::linear : Encoding::automatic;
  taken.scale = 1, taken.invert = false;
  taken.number = ImageNumber::luminance;
  taken.primaries = Primaries::file;
  return taken;
}

// Byte 1 of a Targa file says whether it has a palette.
bool has_palette(const std::string& filename) {
  std::ifstream file = open_input(filename);
  file.seekg(1);
  return file.get() == 1;
}

}  // namespace

bool is_read_by_mitsuba(const std::string& filename) {
  constexpr std::array kinds{".exr",  ".png", ".jpg", ".jpeg", ".hdr",
                             ".rgbe", ".pfm", ".ppm", ".bmp",  ".tga"};
  std::string suffix = std::filesystem::path(filename).extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (std::ranges::find(kinds, suffix) == kinds.end()) return false;
  if (suffix == ".tga") return !has_palette(filename);
  return !suffix.starts_with(".jp") || jpeg_components(filename) != 4;
}

MitsubaImage image_for_mitsuba(Context& context, const ImageTexture& texture, bool is_float,
                               bool is_normal_map, RGB tint) {
  const std::string own = context.relative(texture.filename);
  if (is_normal_map) {
    if (texture.encoding == Encoding::srgb || texture.encoding == Encoding::gamma || texture.scale != 1)
      context.approximated("the encoding of a normal map is not in Mitsuba: its numbers count as they are");
    return {own, true};
  }
  const ImageUse use = is_float ? ImageUse::number : ImageUse::color;
  bool raw = is_float && texture.encoding == Encoding::linear;
  try {
    bool refused = false;
    if (is_float && !raw && tint == RGB{1, 1, 1}) {
      const ImageLayout layout = read_image_layout(texture.filename);
      if (layout.channels >= 3) raw = !layout.integer, refused = layout.integer;
    }
    const bool unread = !is_read_by_mitsuba(texture.filename);
    if (!refused && !unread && tint == RGB{1, 1, 1} &&
        have_same_values(texture, taken_by_mitsuba(texture, raw), use))
      return {own, raw};
    const std::filesystem::path file = context.images.write(texture, use, {tint, {}, false});
    const std::string name = context.relative(std::filesystem::absolute(file).string());
    const char* const why = unread ? "Mitsuba does not read this kind of image: its values"
                            : refused
                                ? "Mitsuba's spectral variants take no number from three channels: the values"
                                : "Mitsuba takes other values from its image: they";
    context.approximated(fmt::format("{} are written as {}", why, name));
    return {name, is_float};
  } catch (const Error& error) {
    context.approximated(fmt::format("{}: referred to as it is", error.what()));
    return {own, raw};
  }
}

std::optional<MitsubaImage> image_for_mitsuba(Context& context, const ImagePair& pair, bool is_float) {
  try {
    const std::filesystem::path file = context.images.write(pair);
    const std::string name = context.relative(std::filesystem::absolute(file).string());
    context.approximated(
        fmt::format("the product of two images is written as one, {}: right at its texels, and between them "
                    "interpolated as a product",
                    name));
    return MitsubaImage{name, is_float};
  } catch (const Error&) {
    return std::nullopt;
  }
}

RGB mean_color(const ImageTexture& texture) {
  try {
    const Image image = texture_values(texture, read_stored_image(texture.filename), ImageUse::color);
    const auto channels = static_cast<std::size_t>(image.channels);
    std::array<double, 3> sum{};
    for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += static_cast<double>(image.values[pixel * channels + std::min(c, channels - 1)]);
    const double count = static_cast<double>(std::max<std::size_t>(image.pixels(), 1));
    return {sum[0] / count, sum[1] / count, sum[2] / count};
  } catch (const Error&) {
    return {0.5, 0.5, 0.5};
  }
}

}  // namespace vitrail::mitsuba_writer
