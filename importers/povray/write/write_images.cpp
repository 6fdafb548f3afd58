// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "importers/povray/write/write_pigments.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/jpeg_components.h"
#include "importers/writing/mesh_files.h"

namespace vitrail::povray {

namespace {

std::string suffix_of(const std::string& filename) {
  std::string suffix = std::filesystem::path(filename).extension().string();
  std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  return suffix;
}

// POV-Ray 3.7 knows no word for .bmp outside of Windows.
const std::map<std::string, std::string>& kinds() {
  static const std::map<std::string, std::string> known{{".png", "png"}, {".jpg", "jpeg"}, {".jpeg", "jpeg"},
                                                        {".tga", "tga"}, {".tif", "tiff"}, {".tiff", "tiff"},
                                                        {".gif", "gif"}, {".ppm", "ppm"},  {".pgm", "pgm"},
                                                        {".iff", "iff"}, {".exr", "exr"},  {".hdr", "hdr"}};
  return known;
}

std::string words_of(const Context& context, const std::string& filename, Encoding encoding, float gamma) {
  const std::string suffix = suffix_of(filename);
  const bool is_linear_kind = suffix == ".exr" || suffix == ".hdr";
  std::string text =
      fmt::format("{} {}", kinds().at(suffix), quoted(relative_name(filename, context.directory)));
  if (encoding == Encoding::gamma) return text + fmt::format(" gamma {}", gamma);
  if (encoding == Encoding::linear || (encoding == Encoding::automatic && is_linear_kind))
    return text + " gamma 1.0";
  return text + " gamma srgb";
}

bool has_transparent_pixels(const ImageTexture& texture) {
  if (read_image_layout(texture.filename).channels % 2 != 0) return false;
  const Image alpha = numbers_of(read_stored_image(texture.filename).image, ImageNumber::alpha);
  return std::ranges::any_of(alpha.values, [](float a) { return a != 1; });
}

// Whether every channel is the number.
bool is_grey(const ImageTexture& texture) {
  if (read_image_layout(texture.filename).channels < 3) return texture.number != ImageNumber::alpha;
  for (const ImageNumber channel : {ImageNumber::red, ImageNumber::green, ImageNumber::blue}) {
    ImageTexture other = texture;
    other.number = channel;
    if (!have_same_values(texture, other, ImageUse::number)) return false;
  }
  return true;
}

bool is_read_by_povray(const std::string& filename) {
  const auto kind = kinds().find(suffix_of(filename));
  return kind != kinds().end() && (kind->second != "jpeg" || jpeg_components(filename) != 4);
}

// POV-Ray sees through pixels by their alpha, and looks at no chromaticities.
bool is_seen_as_meant(const ImageTexture& texture, ImageUse use) {
  if (!is_read_by_povray(texture.filename) || has_transparent_pixels(texture)) return false;
  ImageTexture taken = texture;
  taken.primaries = Primaries::srgb;
  return have_same_values(texture, taken, use) && (use != ImageUse::number || is_grey(texture));
}

// What a texture's numbers are in the mean, and between.
struct Numbers {
  double mean = 0.5, low = 0, high = 1;
};

Numbers numbers_of(const Context& context, const FloatParameter& parameter);

Numbers numbers_of(const Context& context, const SpectrumParameter& parameter) {
  const auto* spectrum = std::get_if<Spectrum>(&parameter);
  if (!spectrum) return numbers_of(context, FloatParameter{std::get<Id<Texture>>(parameter)});
  const double value = mean(factor_rgb(*spectrum));
  return {value, value, value};
}

Numbers numbers_of(const Image& image) {
  if (image.values.empty()) return {};
  const auto [low, high] = std::ranges::minmax(image.values);
  double sum = 0;
  for (const float number : image.values) sum += static_cast<double>(number);
  return {sum / static_cast<double>(image.values.size()), static_cast<double>(low),
          static_cast<double>(high)};
}

Numbers blended(const Numbers& a, const Numbers& b, double amount) {
  return {std::lerp(a.mean, b.mean, amount), std::min(a.low, b.low), std::max(a.high, b.high)};
}

// Over all of it: 0.5 of those whose mean is not known.
Numbers numbers_of(const Context& context, const FloatParameter& parameter) {
  if (const auto* value = std::get_if<float>(&parameter)) {
    const auto v = static_cast<double>(*value);
    return {v, v, v};
  }
  const TextureModel& model = context.scene.textures.at(std::get<Id<Texture>>(parameter).value).model;
  if (const auto* t = std::get_if<ImageTexture>(&model))
    return numbers_of(texture_values(*t, read_stored_image(t->filename), ImageUse::number));
  if (const auto* t = std::get_if<CheckerboardTexture>(&model))
    return blended(numbers_of(context, t->even), numbers_of(context, t->odd), 0.5);
  if (const auto* t = std::get_if<ProductTexture>(&model)) {
    const Numbers a = numbers_of(context, t->first), b = numbers_of(context, t->second);
    return {a.mean * b.mean, a.low * b.low, a.high * b.high};
  }
  if (const auto* t = std::get_if<MixTexture>(&model))
    return blended(numbers_of(context, t->first), numbers_of(context, t->second),
                   numbers_of(context, t->amount).mean);
  if (const auto* t = std::get_if<NoiseTexture>(&model)) return {mean(mean_of_noise(*t))};
  if (const auto* t = std::get_if<MeshAttributeTexture>(&model)) {
    const auto found = mean_of_attribute(context.scene, *t);
    return found ? Numbers{mean(*found)} : Numbers{0, 0, 0};  // as it is rendered
  }
  return {};
}

}  // namespace

double constant_of(Context& context, const FloatParameter& parameter, const char* what, const Origin& user) {
  if (const auto* value = std::get_if<float>(&parameter)) return *value;
  const Texture& texture = context.scene.textures.at(std::get<Id<Texture>>(parameter).value);
  const Origin& place = texture.origin.line ? texture.origin : user;
  try {
    const Numbers numbers = numbers_of(context, parameter);
    context.approximated(fmt::format("texture of the {}: its mean, {:.3g}, of {:.3g} to {:.3g}", what,
                                     numbers.mean, numbers.low, numbers.high),
                         place);
    return numbers.mean;
  } catch (const Error& error) {
    context.approximated(fmt::format("texture of the {}: 0.5: {}", what, error.what()), place);
    return 0.5;
  }
}

std::optional<std::string> image_of(Context& context, const ImageTexture& texture, ImageUse use,
                                    const Origin& origin) {
  // POV-Ray's spheres have s around and t along the axis: there at (s,t) is the image's (t,s).
  const bool exchanged = std::holds_alternative<SphericalMapping>(texture.mapping);
  const UvMapping mapping = exchanged ? UvMapping{0, 1, 0, 1, 0, 0} : UvMapping{};
  ImageTexture plain = texture;
  plain.scale = 1, plain.invert = false;
  try {
    const bool same_values = is_seen_as_meant(plain, use);
    if (same_values && !exchanged)
      return words_of(context, texture.filename, texture.encoding, texture.gamma);
    const std::string file = context.images.write(plain, use, {{1, 1, 1}, mapping, true}).string();
    if (!same_values)
      context.approximated(fmt::format("POV-Ray takes other values from the image {}: they are written as {}",
                                       texture.filename, relative_name(file, context.directory)),
                           origin);
    return words_of(context, file, Encoding::linear, 1);
  } catch (const Error& error) {
    std::error_code ignored;
    const bool is_there = std::filesystem::is_regular_file(texture.filename, ignored);
    if (is_there && !exchanged && is_read_by_povray(texture.filename)) {
      context.approximated(fmt::format("{}: referred to as it is", error.what()), origin);
      return words_of(context, texture.filename, texture.encoding, texture.gamma);
    }
    const char* const why = !is_there   ? "there is no such file"
                            : exchanged ? "it cannot be read"
                                        : "POV-Ray 3.7 does not read this kind";
    context.dropped(fmt::format("image {}: {}; 0.5 is written", texture.filename, why), origin);
    return {};
  }
}

}  // namespace vitrail::povray
