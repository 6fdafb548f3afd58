// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/write/write_images.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "importers/images/environment_images.h"
#include "importers/pbrt/read/image_numbers.h"

namespace vitrail::pbrt {

namespace {

std::string extension_of(const std::string& filename) {
  std::string extension = std::filesystem::path(filename).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

bool is_read_by_pbrt(const std::string& filename) {
  constexpr std::array<std::string_view, 13> known{".png", ".exr", ".pfm", ".hdr", ".qoi", ".jpg", ".jpeg",
                                                   ".tga", ".bmp", ".psd", ".gif", ".ppm", ".pgm"};
  return std::ranges::count(known, extension_of(filename)) > 0;
}

Encoding encoding_taken(const std::string& filename, Encoding wanted) {
  const std::string extension = extension_of(filename);
  const bool is_float = extension == ".exr" || extension == ".pfm" || extension == ".hdr";
  return takes_encoding(filename) || (is_float && wanted == Encoding::linear) ? wanted : Encoding::automatic;
}

// What pbrt makes of the texture's own file.
ImageTexture taken_by_pbrt(const ImageTexture& image, ImageUse use) {
  ImageTexture taken = image;
  taken.encoding = encoding_taken(image.filename, image.encoding);
  taken.number = number_taken(Version::v4, image.filename, image.filter);
  taken.primaries = primaries_taken(Version::v4, use == ImageUse::number);
  return taken;
}

// The same where nothing but the name is given.
ImageTexture taken_by_name(const ImageTexture& image, ImageUse use) {
  ImageTexture plain = image;
  plain.encoding = use == ImageUse::vector ? Encoding::linear : Encoding::automatic;
  plain.scale = 1, plain.invert = false;
  return taken_by_pbrt(plain, use);
}

// pbrt's lights and normal maps refuse greys. What is not there cannot be helped.
bool has_three_channels(const ImageTexture& image) {
  try {
    return read_image_layout(image.filename).channels >= 3;
  } catch (const Error&) {
    return true;
  }
}

std::string written(Parameters& p, const ImageTexture& image, ImageUse use, const ImageChange& change) {
  const std::filesystem::path file = p.writer().images.write(image, use, change);
  p.approximated(fmt::format("pbrt takes other values from its image: they are written as {}",
                             relative_name(file.string(), p.writer().directory)));
  return file.string();
}

}  // namespace

ImageTexture image_for_pbrt(Parameters& p, const ImageTexture& image, ImageUse use, RGB tint) {
  ImageTexture taken = taken_by_pbrt(image, use);
  try {
    // pbrt repeats images and does not mirror them: four, of which three are mirrored, repeat as one does.
    if (const auto* uv = std::get_if<UvMapping>(&image.mapping); uv && image.wrap == Wrap::mirror) {
      const UvMapping twice{2, 0, 0, 0, 2, 0}, half{0.5f, 0, 0, 0, 0.5f, 0};
      ImageTexture four;
      four.filename = written(p, image, use, {tint, twice, false});
      four.mapping = composed(half, *uv), four.filter = image.filter;
      return four;
    }
    if (tint == RGB{1, 1, 1} && is_read_by_pbrt(image.filename) && have_same_values(image, taken, use))
      return taken;
    ImageTexture values;
    values.filename = written(p, image, use, {tint, {}, false});
    values.mapping = image.mapping, values.wrap = image.wrap, values.filter = image.filter;
    return values;
  } catch (const Error& error) {
    p.approximated(fmt::format("{}: referred to as it is", error.what()));
    return taken;
  }
}

std::optional<std::string> file_for_pbrt(Parameters& p, Id<Texture> texture, ImageUse use,
                                         const ImageChange& besides) {
  const auto tinted = tinted_image(p.writer().scene, texture);
  if (!tinted) return {};
  const ImageTexture& image = tinted->image;
  ImageChange change = besides;
  change.three_channels = true;
  change.tint = {tinted->tint.r * besides.tint.r, tinted->tint.g * besides.tint.g,
                 tinted->tint.b * besides.tint.b};
  if (const auto* uv = std::get_if<UvMapping>(&image.mapping))
    change.mapping = composed(*uv, besides.mapping);
  else
    p.approximated("its image is mapped by the uv, not by position");
  try {
    const bool as_it_is = change.tint == RGB{1, 1, 1} && change.mapping == UvMapping{} &&
                          change.cosine_power == 0 && !change.spot && is_read_by_pbrt(image.filename) &&
                          have_same_values(image, taken_by_name(image, use), use) &&
                          has_three_channels(image);
    return as_it_is ? image.filename : written(p, image, use, change);
  } catch (const Error& error) {
    p.approximated(fmt::format("{}: referred to as it is", error.what()));
    return image.filename;
  }
}

// pbrt-v4 takes the equal-area map alone: `values`, which were of latitude and longitude.
static std::string resampled(Parameters& p, const Image& values) {
  const std::filesystem::path file = std::filesystem::absolute(p.writer().new_image());
  write_exr_image(file, values);
  p.approximated("its image of latitude and longitude is resampled to the equal-area map");
  return file.string();
}

// pbrt takes the mean of the colours, and knows no alpha.
std::string goniometric_for_pbrt(Parameters& p, const GoniometricLight& light) {
  const ImageTexture image = image_of(light);
  ImageTexture taken = taken_by_name(image, ImageUse::number);
  taken.number = ImageNumber::mean;
  using enum EnvironmentLight::Projection;
  try {
    if (light.latitude_longitude) {
      const Image values = texture_values(image, read_stored_image(light.filename), ImageUse::number);
      return resampled(p, reproject(values, latitude_longitude, equal_area));
    }
    if (have_same_values(image, taken, ImageUse::number)) return light.filename;
    return written(p, image, ImageUse::number, {});
  } catch (const Error& error) {
    p.approximated(fmt::format("{}: referred to as it is", error.what()));
    return light.filename;
  }
}

// pbrt-v4 reads equal-area maps alone, of three channels.
std::string environment_for_pbrt(Parameters& p, const EnvironmentLight& light, RGB tint) {
  using enum EnvironmentLight::Projection;
  const ImageTexture image = image_of(light);
  try {
    if (light.projection == equal_area) {
      if (tint == RGB{1, 1, 1} && has_three_channels(image) &&
          have_same_values(image, taken_by_name(image, ImageUse::light), ImageUse::light))
        return light.filename;
      return written(p, image, ImageUse::light, {tint, {}, true});
    }
    Image values = texture_values(image, read_stored_image(light.filename), ImageUse::light);
    values = with_three_channels(reproject(values, latitude_longitude, equal_area));
    multiply(values, tint);
    return resampled(p, values);
  } catch (const Error& error) {
    p.dropped(fmt::format("its image cannot be resampled to the equal-area map: {}", error.what()));
    return light.filename;
  }
}

}  // namespace vitrail::pbrt
