// SPDX-License-Identifier: Apache-2.0
#include "images/texture_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace vitrail {

namespace {

// Applies a function of one number. Most images have few different values.
template <class F>
void transform_values(Image& image, F&& f) {
  struct Known {
    float from = std::numeric_limits<float>::quiet_NaN(), to = 0;
  };
  std::vector<Known> known(4096);
  for (float& value : image.values) {
    Known& k = known[std::bit_cast<std::uint32_t>(value) * 0x9e3779b1u >> 20];
    if (k.from != value) k = {value, static_cast<float>(f(static_cast<double>(value)))};
    value = k.to;
  }
}

void decode(Image& image, const ImageTexture& texture, bool integer, ImageUse use) {
  const bool automatic = texture.encoding == Encoding::automatic && use != ImageUse::vector;
  if (texture.encoding == Encoding::srgb || (automatic && integer))
    transform_values(image, [](double v) { return srgb_decode(std::clamp(v, 0.0, 1.0)); });
  if (texture.encoding == Encoding::gamma)
    transform_values(image, [gamma = static_cast<double>(texture.gamma)](double v) {
      return std::pow(std::max(v, 0.0), gamma);
    });
}

Image without_alpha(Image image) {
  if (!image.has_alpha()) return image;
  const auto from = static_cast<std::size_t>(image.channels), to = from - 1;
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel)
    for (std::size_t c = 0; c < to; ++c) image.values[pixel * to + c] = image.values[pixel * from + c];
  image.channels = static_cast<int>(to);
  image.values.resize(image.pixels() * to);
  return image;
}

// What red, green and blue of the file are; nothing where they are those of sRGB.
std::optional<std::array<RGB, 3>> primaries_of(const StoredImage& stored, Primaries meaning, ImageUse use) {
  if (!stored.chromaticities || stored.image.channels < 3 || meaning == Primaries::srgb) return {};
  const char* const name = color_space_of(*stored.chromaticities);
  if (name && std::string(name) == "srgb") return {};
  if (meaning == Primaries::named && !name) return {};
  if (meaning == Primaries::named && use != ImageUse::light)
    return std::array{to_srgb({1, 0, 0}, name), to_srgb({0, 1, 0}, name), to_srgb({0, 0, 1}, name)};
  return primaries_in_srgb(*stored.chromaticities);
}

void to_linear_srgb(Image& image, const std::array<RGB, 3>& primaries) {
  const auto& [r, g, b] = primaries;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel) {
    float* const v = &image.values[pixel * channels];
    const double red = static_cast<double>(v[0]), green = static_cast<double>(v[1]),
                 blue = static_cast<double>(v[2]);
    v[0] = static_cast<float>(red * r.r + green * g.r + blue * b.r);
    v[1] = static_cast<float>(red * r.g + green * g.g + blue * b.g);
    v[2] = static_cast<float>(red * r.b + green * g.b + blue * b.b);
  }
}

// ITU-R BT.709's weights as pbrt-v3 and Mitsuba have them.
double luminance_of(const float* rgb) {
  return 0.212671 * static_cast<double>(rgb[0]) + 0.715160 * static_cast<double>(rgb[1]) +
         0.072169 * static_cast<double>(rgb[2]);
}

bool alpha_varies(const Image& image) {
  if (!image.has_alpha()) return false;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = channels - 1; i < image.values.size(); i += channels)
    if (image.values[i] != 1) return true;
  return false;
}

bool is_choice(ImageNumber number) {
  return number == ImageNumber::alpha_or_mean || number == ImageNumber::alpha_or_luminance;
}

// Without choice: of an image with another alpha than 1, or without.
ImageNumber chosen(ImageNumber number, bool alpha_varies) {
  if (is_choice(number) && alpha_varies) return ImageNumber::alpha;
  if (number == ImageNumber::alpha_or_mean) return ImageNumber::mean;
  return number == ImageNumber::alpha_or_luminance ? ImageNumber::luminance : number;
}

double number_of(const float* pixel, int channels, ImageNumber number) {
  const bool grey = channels < 3;
  switch (number) {
    case ImageNumber::alpha:
      return channels % 2 == 0 ? static_cast<double>(pixel[channels - 1]) : 1;
    case ImageNumber::green:
      return static_cast<double>(pixel[grey ? 0 : 1]);
    case ImageNumber::blue:
      return static_cast<double>(pixel[grey ? 0 : 2]);
    case ImageNumber::red:
      return static_cast<double>(pixel[0]);
    case ImageNumber::mean:
      if (grey) return static_cast<double>(pixel[0]);
      return (static_cast<double>(pixel[0]) + static_cast<double>(pixel[1]) + static_cast<double>(pixel[2])) /
             3;
    default:
      return grey ? static_cast<double>(pixel[0]) : luminance_of(pixel);
  }
}

// Whatever else the two have, they take the same from a file of their name.
bool say_the_same(const ImageTexture& a, const ImageTexture& b, ImageUse use) {
  const bool states_primaries = use != ImageUse::vector && a.filename.ends_with(".exr");
  return a.filename == b.filename && a.encoding == b.encoding && a.gamma == b.gamma && a.scale == b.scale &&
         a.invert == b.invert && (!states_primaries || a.primaries == b.primaries) &&
         (use != ImageUse::number || a.number == b.number);
}

}  // namespace

Image numbers_of(const Image& image, ImageNumber number) {
  Image result = black_image(image.width, image.height, 1);
  const auto channels = static_cast<std::size_t>(image.channels);
  const ImageNumber taken = is_choice(number) ? chosen(number, alpha_varies(image)) : number;
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel)
    result.values[pixel] =
        static_cast<float>(number_of(&image.values[pixel * channels], image.channels, taken));
  return result;
}

ImageTexture without_choice(ImageTexture texture) {
  if (!is_choice(texture.number)) return texture;
  bool varies = false;
  read_stored_rows(texture.filename,
                   [&](const StoredImage& rows) { varies = varies || alpha_varies(rows.image); });
  texture.number = chosen(texture.number, varies);
  return texture;
}

Image texture_values(const ImageTexture& texture, StoredImage stored, ImageUse use) {
  Image& image = stored.image;
  if (use != ImageUse::number)
    image = without_alpha(std::move(image));
  else if (texture.number == ImageNumber::stored_luminance)
    image = numbers_of(image, ImageNumber::luminance);
  decode(image, texture, stored.integer, use);
  if (use != ImageUse::vector)
    if (const auto primaries = primaries_of(stored, texture.primaries, use))
      to_linear_srgb(image, *primaries);
  if (use == ImageUse::number) image = numbers_of(image, texture.number);
  if (texture.scale != 1 || texture.invert)
    transform_values(image, [&, scale = static_cast<double>(texture.scale)](double v) {
      return texture.invert ? 1 - v * scale : v * scale;
    });
  return std::move(image);
}

bool ignores_primaries(const ImageTexture& texture, const ImageLayout& layout) {
  if (!layout.chromaticities || layout.channels < 3 || texture.primaries == Primaries::file) return false;
  const char* const name = color_space_of(*layout.chromaticities);
  if (name && std::string(name) == "srgb") return false;
  return texture.primaries == Primaries::srgb || !name;
}

bool have_same_values(const ImageTexture& a, const ImageTexture& b, ImageUse use) {
  if (say_the_same(a, b, use)) return true;
  const StoredImage stored = read_stored_image(a.filename);
  const StoredImage other = a.filename == b.filename ? stored : read_stored_image(b.filename);
  const Image first = texture_values(a, stored, use), second = texture_values(b, other, use);
  if (first.width != second.width || first.height != second.height || first.channels != second.channels)
    return false;
  return std::equal(first.values.begin(), first.values.end(), second.values.begin(), [](float x, float y) {
    return x == y || std::abs(x - y) <= 1e-6f * std::max(std::abs(x), std::abs(y)) || (x != x && y != y);
  });
}

ImageTexture image_of(const EnvironmentLight& light) {
  ImageTexture image;
  image.filename = light.filename;
  image.encoding = light.encoding;
  image.primaries = light.primaries;
  return image;
}

ImageTexture image_of(const GoniometricLight& light) {
  ImageTexture image;
  image.filename = light.filename;
  image.encoding = light.encoding;
  image.number = light.number;
  image.primaries = Primaries::srgb;
  return image;
}

}  // namespace vitrail
