// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write_images.h"

#include <algorithm>
#include <cmath>

#include "images/image_files.h"

namespace vitrail::mitsuba_writer {

namespace {

bool is_srgb(const ImageTexture& texture, bool integer) {
  return texture.encoding == Encoding::srgb || (texture.encoding == Encoding::automatic && integer);
}

// The texture's values: decoded, scaled, inverted.
Image values_of(const ImageTexture& texture, StoredImage stored) {
  const bool srgb = is_srgb(texture, stored.integer);
  for (float& stored_value : stored.image.values) {
    double value = static_cast<double>(stored_value);
    if (srgb) value = srgb_decode(std::clamp(value, 0.0, 1.0));
    if (texture.encoding == Encoding::gamma)
      value = std::pow(std::max(value, 0.0), static_cast<double>(texture.gamma));
    value *= static_cast<double>(texture.scale);
    stored_value = static_cast<float>(texture.invert ? 1 - value : value);
  }
  return std::move(stored.image);
}

// A float texture counts a colour image by its mean.
Image grey(const Image& image) {
  if (image.channels == 1) return image;
  Image result = black_image(image.width, image.height, 1);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel) {
    double sum = 0;
    for (std::size_t c = 0; c < channels; ++c) sum += static_cast<double>(image.values[pixel * channels + c]);
    result.values[pixel] = static_cast<float>(sum / static_cast<double>(channels));
  }
  return result;
}

}  // namespace

MitsubaImage image_for_mitsuba(Context& context, Id<Texture> id) {
  const bool is_float = context.scene.textures[id.value].is_float;
  const auto& texture = std::get<ImageTexture>(context.scene.textures[id.value].model);
  const std::string own = context.relative(texture.filename);
  const bool linear = texture.encoding == Encoding::linear;
  if (context.roles.normal_map[id.value]) {
    if (texture.encoding == Encoding::srgb || texture.encoding == Encoding::gamma || texture.scale != 1)
      context.approximated("the encoding of a normal map is not in Mitsuba: its numbers count as they are");
    return {own, true};
  }
  const bool plain = texture.scale == 1 && !texture.invert && texture.encoding != Encoding::gamma;
  if (plain && !is_float && texture.encoding == Encoding::automatic) return {own, false};
  try {
    const ImageLayout layout = read_image_layout(texture.filename);
    const bool decoded = is_srgb(texture, layout.integer);
    if (plain && decoded == layout.integer && (!is_float || layout.channels == 1))
      return {own, is_float && linear};
    if (plain && !decoded && is_float && layout.channels == 1) return {own, true};
    const Image values = values_of(texture, read_stored_image(texture.filename));
    const std::string name = context.new_file("images", "exr", context.derived_images);
    write_exr_image(context.file.parent_path() / name, is_float ? grey(values) : values);
    context.approximated(fmt::format("Mitsuba cannot decode this image: its values are written as {}", name));
    return {name, is_float};
  } catch (const Error& error) {
    context.approximated(fmt::format("{}: referred to as it is", error.what()));
    return {own, is_float && linear};
  }
}

RGB mean_color(const ImageTexture& texture) {
  try {
    const Image image = values_of(texture, read_stored_image(texture.filename));
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
