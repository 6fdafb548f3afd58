// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/write/mtl_text.h"

#include <fmt/format.h>

#include <map>

#include "importers/writing/mesh_files.h"

namespace vitrail {

void MtlText::line(const char* keyword, RGB c) {
  // The Scene's colours are floats.
  text += fmt::format("{} {} {} {}\n", keyword, static_cast<float>(c.r), static_cast<float>(c.g),
                      static_cast<float>(c.b));
}
void MtlText::line(const char* keyword, double value) { text += fmt::format("{} {}\n", keyword, value); }
void MtlText::line(const char* keyword, float value) { text += fmt::format("{} {}\n", keyword, value); }

// Without -imfchan readers take luminance, of map_d alpha where there is one.
std::string MtlText::channel_option(const char* keyword, const ImageTexture& image) {
  using enum ImageNumber;
  const ImageNumber otherwise = std::string(keyword) == "map_d" ? alpha_or_luminance : luminance;
  if (image.number == otherwise) return "";
  static const std::map<ImageNumber, char> letters{
      {red, 'r'}, {green, 'g'}, {blue, 'b'}, {alpha, 'm'}, {luminance, 'l'}};
  if (const auto letter = letters.find(image.number); letter != letters.end())
    return fmt::format("-imfchan {} ", letter->second);
  ImageTexture taken = image;
  taken.number = otherwise;
  try {
    if (have_same_values(image, taken, ImageUse::number)) return "";
    approximated(fmt::format("channels of the image of {}: their luminance, or its alpha", keyword));
  } catch (const Error& error) {
    approximated(fmt::format("image of {}: {}", keyword, error.what()));
  }
  return "";
}

void MtlText::map(const char* keyword, const ImageTexture& image, ImageUse use, const char* scale_option) {
  std::string options;
  const auto* uv = std::get_if<UvMapping>(&image.mapping);
  if (!uv || uv->b != 0 || uv->d != 0) {
    approximated(fmt::format("mapping of the image of {}: the uv themselves", keyword));
  } else {
    if (uv->a != 1 || uv->e != 1) options += fmt::format("-s {} {} 1 ", uv->a, uv->e);
    if (uv->c != 0 || uv->f != 0) options += fmt::format("-o {} {} 0 ", uv->c, uv->f);
  }
  if (image.wrap == Wrap::clamp) options += "-clamp on ";
  if (image.wrap == Wrap::mirror || image.wrap == Wrap::black)
    approximated(fmt::format("image of {} that is mirrored or black outside: it repeats", keyword));
  const Encoding expected = use == ImageUse::color ? Encoding::automatic : Encoding::linear;
  if (image.encoding != expected) approximated(fmt::format("encoding of the image of {}", keyword));
  if (image.invert) approximated(fmt::format("inverted image of {}: as it is in the file", keyword));
  if (use == ImageUse::number) options += channel_option(keyword, image);
  if (scale_option && image.scale != 1) options += fmt::format("{} {} ", scale_option, image.scale);
  text += fmt::format("{} {}{}\n", keyword, options, relative_name(image.filename, folder_));
}

bool MtlText::map(const char* keyword, Id<Texture> id, ImageUse use, const char* scale_option) {
  const auto* image = std::get_if<ImageTexture>(&scene_.textures.at(id.value).model);
  if (image) map(keyword, *image, use, scale_option);
  return image != nullptr;
}

void MtlText::color(const char* keyword, const char* map_keyword, const SpectrumParameter& parameter,
                    RGB (*rgb)(const Spectrum&), double factor) {
  if (const auto* spectrum = std::get_if<Spectrum>(&parameter)) {
    if (!is_rgb(*spectrum)) approximated("spectrum: written as its colour in linear sRGB");
    const RGB c = rgb(*spectrum);
    return line(keyword, RGB{c.r * factor, c.g * factor, c.b * factor});
  }
  if (const auto tinted = tinted_image(scene_, std::get<Id<Texture>>(parameter))) {
    const double scale = static_cast<double>(tinted->image.scale) * factor;
    const RGB& c = tinted->tint;
    line(keyword, RGB{c.r * scale, c.g * scale, c.b * scale});
    return map(map_keyword, tinted->image, ImageUse::color, nullptr);
  }
  if (const BakedTexture* baked = baked_.bake(std::get<Id<Texture>>(parameter))) {
    approximated(baked->note);
    const double scale = static_cast<double>(baked->image.scale) * factor;
    line(keyword, RGB{scale, scale, scale});
    return map(map_keyword, baked->image, ImageUse::color, nullptr);
  }
  approximated(fmt::format("texture of {} that is no image: 0.5", keyword));
  line(keyword, RGB{0.5 * factor, 0.5 * factor, 0.5 * factor});
}

double MtlText::constant(const FloatParameter& parameter, const char* what) {
  if (const auto* value = std::get_if<float>(&parameter)) return *value;
  approximated(fmt::format("texture of the {}: 0.5", what));
  return 0.5;
}

void MtlText::number(const char* keyword, const char* map_keyword, const FloatParameter& parameter) {
  if (const auto* value = std::get_if<float>(&parameter)) return line(keyword, *value);
  const Id<Texture> id = std::get<Id<Texture>>(parameter);
  if (map_keyword && map(map_keyword, id, ImageUse::number, "-mm 0")) return;
  if (const BakedTexture* baked = map_keyword ? baked_.bake(id) : nullptr) {
    approximated(baked->note);
    return map(map_keyword, baked->image, ImageUse::number, "-mm 0");
  }
  approximated(fmt::format("texture of {}: 0.5", keyword));
  line(keyword, 0.5);
}

}  // namespace vitrail
