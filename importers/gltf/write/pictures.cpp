// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/write/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "images/file_part.h"
#include "images/image_codec.h"
#include "images/texture_values.h"
#include "importers/gltf/write/values.h"
#include "scene/spectra/color.h"
#include "scene/system/input_files.h"

namespace vitrail::gltf {

namespace {

std::vector<std::byte> file_bytes(const std::string& name) {
  if (const auto part = file_part(name)) return read_part(*part);
  check_input(name);
  const RegularFile file(name);
  std::vector<std::byte> bytes(file.size());
  if (!file.is_open() || !file.read(bytes, 0)) throw Error("cannot read the image", {name});
  return bytes;
}

int wrap_of(Wrap wrap) {
  return wrap == Wrap::clamp    ? TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE
         : wrap == Wrap::mirror ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                : TINYGLTF_TEXTURE_WRAP_REPEAT;
}

Image resized(const Image& image, int width, int height) {
  if (image.width == width && image.height == height) return image;
  Image out = black_image(width, height, image.channels);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto from =
          static_cast<std::size_t>(y * image.height / height) * static_cast<std::size_t>(image.width) +
          static_cast<std::size_t>(x * image.width / width);
      const auto to =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      for (std::size_t c = 0; c < channels; ++c)
        out.values[to * channels + c] = image.values[from * channels + c];
    }
  return out;
}

}  // namespace

// glTF scales, turns and moves (u,v): a shear cannot be said.
tinygltf::TextureInfo Pictures::info(int image, const ImageTexture& like) {
  tinygltf::TextureInfo info;
  tinygltf::Sampler sampler;
  sampler.wrapS = sampler.wrapT = wrap_of(like.wrap);
  sampler.magFilter = like.filter == TextureFilter::nearest ? TINYGLTF_TEXTURE_FILTER_NEAREST
                                                            : TINYGLTF_TEXTURE_FILTER_LINEAR;
  if (like.wrap == Wrap::black) notes_.approximated("an image that is black outside: it repeats");
  const auto same_sampler = std::ranges::find(model_.samplers, sampler);
  const int sampler_index = static_cast<int>(same_sampler - model_.samplers.begin());
  if (same_sampler == model_.samplers.end()) model_.samplers.push_back(sampler);
  tinygltf::Texture texture;
  texture.sampler = sampler_index, texture.source = image;
  const auto same = std::ranges::find(model_.textures, texture);
  info.index = static_cast<int>(same - model_.textures.begin());
  if (same == model_.textures.end()) model_.textures.push_back(texture);

  const auto* m = std::get_if<UvMapping>(&like.mapping);
  if (!m) {
    notes_.approximated("an image that is not laid out by (u,v): it is laid out by them");
    return info;
  }
  const double a = m->a, b = m->b, d = m->d, e = m->e;
  const double width = std::hypot(a, d), sign = a * -e + b * d < 0 ? -1 : 1, height = sign * std::hypot(b, e);
  const double rotation = width > 0 ? std::atan2(d, a) : std::atan2(b * sign, -e * sign);
  if (std::abs(a * b + d * e) > 1e-6 * std::abs(width * height))
    notes_.approximated("a sheared image: it is turned and scaled alone");
  tinygltf::Value::Object transform;
  const double x = static_cast<double>(m->c), y = 1 - static_cast<double>(m->f);
  if (x != 0 || y != 0) transform["offset"] = list({x, y});
  if (rotation != 0) transform["rotation"] = tinygltf::Value(rotation);
  if (width != 1 || height != 1) transform["scale"] = list({width, height});
  if (transform.empty()) return info;
  info.extensions["KHR_texture_transform"] = tinygltf::Value(transform);
  use(model_, "KHR_texture_transform");
  return info;
}

int Pictures::image_of_bytes(const std::vector<std::byte>& bytes, const char* kind) {
  tinygltf::Image image;
  image.mimeType = kind;
  image.bufferView = binary_.bytes(bytes);
  model_.images.push_back(std::move(image));
  return static_cast<int>(model_.images.size()) - 1;
}

// −1 where it is neither PNG nor JPEG.
int Pictures::image_of_file(const std::string& file) {
  const auto [known, is_new] = files_.try_emplace(file, -1);
  if (!is_new) return known->second;
  const std::vector<std::byte> bytes = file_bytes(file);
  const std::string suffix = picture_suffix(bytes);
  if (suffix == ".png") known->second = image_of_bytes(bytes, "image/png");
  if (suffix == ".jpg") known->second = image_of_bytes(bytes, "image/jpeg");
  return known->second;
}

tinygltf::TextureInfo Pictures::colors(const ImageTexture& texture, bool linear) {
  const bool as_it_is = !texture.invert && (linear ? texture.encoding == Encoding::linear
                                                   : texture.encoding == Encoding::automatic ||
                                                         texture.encoding == Encoding::srgb);
  if (as_it_is)
    if (const int image = image_of_file(texture.filename); image >= 0) return info(image, texture);
  ImageTexture unscaled = texture;
  unscaled.scale = 1;
  return composed({{&unscaled, 0}, {&unscaled, 1}, {&unscaled, 2}}, !linear);
}

tinygltf::TextureInfo Pictures::composed(const std::vector<Channel>& channels, bool colors) {
  std::vector<Image> values(channels.size());
  const ImageTexture* first = nullptr;
  int width = 1, height = 1;
  std::string key = colors ? "c" : "d";
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const ImageTexture* t = channels[i].texture;
    key += fmt::format("|{} {}", channels[i].of_color, channels[i].constant);
    if (!t) continue;
    key += fmt::format(" {} {} {} {} {} {}", t->filename, static_cast<int>(t->encoding), t->gamma, t->scale,
                       t->invert, static_cast<int>(t->number));
    if (first && first->mapping != t->mapping)
      notes_.approximated("images of one material that are laid out differently: as the first one");
    if (!first) first = t;
    values[i] = texture_values(*t, read_stored_image(t->filename),
                               channels[i].of_color < 0 ? ImageUse::number
                               : colors                 ? ImageUse::color
                                                        : ImageUse::vector);
    width = std::max(width, values[i].width), height = std::max(height, values[i].height);
  }
  const auto [known, is_new] = composed_.try_emplace(key, 0);
  if (!is_new) return info(known->second, *first);
  bool clipped = false;
  PictureFile picture;
  picture.width = picture.full_width = width, picture.height = picture.full_height = height;
  picture.are_integers = true, picture.bits = 8;
  for (std::size_t i = 0; i < channels.size(); ++i)
    picture.channels.push_back({std::string(1, "RGBA"[i]), false});
  std::vector<unsigned char> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                                    channels.size());
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Image image = channels[i].texture ? resized(values[i], width, height) : Image{};
    const auto each = static_cast<std::size_t>(std::max(image.channels, 1));
    const auto at =
        each >= 3 && channels[i].of_color > 0 ? static_cast<std::size_t>(channels[i].of_color) : 0;
    for (std::size_t p = 0; p < pixels.size() / channels.size(); ++p) {
      const double value =
          static_cast<double>(channels[i].texture ? image.values[p * each + at] : channels[i].constant);
      clipped = clipped || value > 1 + 1e-6 || value < -1e-6;
      const double held = std::clamp(value, 0.0, 1.0);
      pixels[p * channels.size() + i] =
          static_cast<unsigned char>(std::lround(255 * (colors && i < 3 ? srgb_encode(held) : held)));
    }
  }
  if (clipped) notes_.approximated("an image with values outside of 0 … 1: they are held there");
  std::vector<std::byte> bytes;
  if (const std::string problem = image_codec().encode_picture("image.png", picture, pixels.data(), bytes);
      !problem.empty())
    throw MachineError("cannot write a PNG: " + problem);
  known->second = image_of_bytes(bytes, "image/png");
  return info(known->second, *first);
}

}  // namespace vitrail::gltf
