// SPDX-License-Identifier: Apache-2.0
#include "film/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "scene/atomic_file.h"
#include "scene/diagnostics.h"

namespace vitrail {

namespace {

std::string fixed_date() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t seconds = epoch ? std::strtoll(epoch, nullptr, 10) : 0;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc);
  return text;
}

OIIO::ImageSpec spec_of(const Picture& picture, int channels, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(picture.rgb.width, picture.rgb.height, channels, type);
  spec.x = picture.window.x0;
  spec.y = picture.window.y0;
  spec.full_x = spec.full_y = 0;
  spec.full_width = std::max(picture.full_width, picture.rgb.width);
  spec.full_height = std::max(picture.full_height, picture.rgb.height);
  spec.attribute("DateTime", fixed_date());
  return spec;
}

void write_file(const std::filesystem::path& file, const OIIO::ImageSpec& spec, const void* pixels) {
  OIIO::Filesystem::IOVecOutput memory;
  const auto out = OIIO::ImageOutput::create(file.string(), &memory);
  if (!out || !out->open(file.string(), spec) || !out->write_image(spec.format, pixels) || !out->close())
    throw MachineError(
        fmt::format("cannot write {}: {}", file.string(), out ? out->geterror() : OIIO::geterror()));
  AtomicFile target(file);
  target.write(std::as_bytes(std::span(memory.buffer())));
  target.commit();
}

void write_exr(const std::filesystem::path& file, const Picture& picture) {
  const bool with_variance = picture.variance.pixels() > 0;
  OIIO::ImageSpec spec = spec_of(picture, with_variance ? 4 : 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  if (picture.samples_per_pixel > 0) spec.attribute("samplesPerPixel", picture.samples_per_pixel);
  if (picture.render_time_s > 0)
    spec.attribute("renderTimeSeconds", static_cast<float>(picture.render_time_s));
  if (!with_variance) return write_file(file, spec, picture.rgb.values.data());
  spec.channelnames = {"R", "G", "B", "Variance.Y"};
  spec.alpha_channel = -1;
  std::vector<float> pixels;
  pixels.reserve(4 * picture.rgb.pixels());
  for (std::size_t p = 0; p < picture.rgb.pixels(); ++p) {
    pixels.insert(pixels.end(), &picture.rgb.values[3 * p], &picture.rgb.values[3 * p] + 3);
    pixels.push_back(picture.variance.values[p]);
  }
  write_file(file, spec, pixels.data());
}

void write_png(const std::filesystem::path& file, const Picture& picture) {
  std::vector<unsigned char> pixels(picture.rgb.values.size());
  std::transform(picture.rgb.values.begin(), picture.rgb.values.end(), pixels.begin(), [](float linear) {
    const double encoded = srgb_encode(std::clamp(static_cast<double>(linear), 0.0, 1.0));
    return static_cast<unsigned char>(std::lround(255 * encoded));
  });
  OIIO::ImageSpec spec = spec_of(picture, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  write_file(file, spec, pixels.data());
}

// The channels that hold R, G and B, by name, else by position; all the same one for grey.
std::array<int, 3> color_channels(const OIIO::ImageSpec& spec) {
  const std::array<int, 3> named{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (*std::min_element(named.begin(), named.end()) >= 0) return named;
  if (spec.nchannels >= 3) return {0, 1, 2};
  return {0, 0, 0};
}

Image select_channels(const OIIO::ImageSpec& spec, const std::vector<float>& values,
                      std::span<const int> channels) {
  Image image = black_image(spec.width, spec.height, static_cast<int>(channels.size()));
  float* out = image.values.data();
  for (std::size_t p = 0; p < image.pixels(); ++p)
    for (const int c : channels)
      *out++ = values[p * static_cast<std::size_t>(spec.nchannels) + static_cast<std::size_t>(c)];
  return image;
}

}  // namespace

void write_picture(const std::filesystem::path& file, const Picture& picture) {
  if (file.extension() == ".exr") return write_exr(file, picture);
  if (file.extension() == ".png") return write_png(file, picture);
  throw UsageError(fmt::format("cannot write {}: images are written as .exr or .png", file.string()));
}

Picture read_picture(const std::filesystem::path& file) {
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) throw Error(fmt::format("cannot read the image: {}", OIIO::geterror()), {file.string()});
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.depth > 1) throw Error("volumes are not images", {file.string()});
  std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    throw Error(fmt::format("cannot read the image: {}", in->geterror()), {file.string()});
  Picture picture;
  picture.rgb = select_channels(spec, values, color_channels(spec));
  if (!spec.format.is_floating_point())
    for (float& v : picture.rgb.values) v = static_cast<float>(srgb_decode(static_cast<double>(v)));
  if (const int variance = spec.channelindex("Variance.Y"); variance >= 0)
    picture.variance = select_channels(spec, values, std::span(&variance, 1));
  picture.window = {spec.x, spec.x + spec.width, spec.y, spec.y + spec.height};
  picture.full_width = spec.full_width;
  picture.full_height = spec.full_height;
  picture.samples_per_pixel = spec.get_int_attribute("samplesPerPixel");
  picture.render_time_s = static_cast<double>(spec.get_float_attribute("renderTimeSeconds"));
  return picture;
}

}  // namespace vitrail
