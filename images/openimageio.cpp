// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "images/image_codec.h"

namespace vitrail {

namespace {

// The channels R, G and B by name, else the first three; the first alone of a picture with fewer. After them
// alpha, where there is one.
std::vector<int> channels_of(const OIIO::ImageSpec& spec) {
  std::vector<int> channels{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (*std::min_element(channels.begin(), channels.end()) < 0)
    channels = spec.nchannels >= 3 ? std::vector{0, 1, 2} : std::vector{0};
  const int alpha = spec.alpha_channel;
  if (alpha >= 0 && std::find(channels.begin(), channels.end(), alpha) == channels.end())
    channels.push_back(alpha);
  return channels;
}

std::optional<Chromaticities> chromaticities_of(const OIIO::ImageSpec& spec) {
  std::array<float, 8> v{};
  if (!spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), v.data())) return {};
  return Chromaticities{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}};
}

// Colours are as stored: OpenImageIO would multiply alpha into them.
std::unique_ptr<OIIO::ImageInput> open(const std::string& file) {
  OIIO::ImageSpec wanted;
  wanted.attribute("oiio:UnassociatedAlpha", 1);
  return OIIO::ImageInput::open(file, &wanted);
}

std::string read(const std::string& file, ImageLayout& layout, Image* image) {
  const auto in = open(file);
  if (!in) return OIIO::geterror();
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.depth > 1) return "volumes are not images";
  const std::vector<int> channels = channels_of(spec);
  layout = {spec.width, spec.height, static_cast<int>(channels.size()), !spec.format.is_floating_point(),
            chromaticities_of(spec)};
  if (!image) return {};
  std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) return in->geterror();
  *image = black_image(layout.width, layout.height, layout.channels);
  float* out = image->values.data();
  for (std::size_t pixel = 0; pixel < image->pixels(); ++pixel)
    for (const int channel : channels)
      *out++ = values[pixel * static_cast<std::size_t>(spec.nchannels) + static_cast<std::size_t>(channel)];
  return {};
}

// Rows of tiles, or as many scan lines as take about so much.
constexpr std::size_t band_bytes = std::size_t{4} << 20;

std::string read_rows(const std::string& file, ImageLayout& layout, const std::function<void(Image)>& visit) {
  if (std::string problem = read(file, layout, nullptr); !problem.empty()) return problem;
  const auto in = open(file);
  if (!in) return OIIO::geterror();
  const OIIO::ImageSpec& spec = in->spec();
  const std::vector<int> channels = channels_of(spec);
  const auto [first, last] = std::minmax_element(channels.begin(), channels.end());
  const int begin = *first, end = *last + 1;
  const auto stride = static_cast<std::size_t>(end - begin);
  const std::size_t row = static_cast<std::size_t>(spec.width) * stride;
  const int lines =
      static_cast<int>(std::max<std::size_t>(1, band_bytes / sizeof(float) / std::max<std::size_t>(row, 1)));
  const int step = spec.tile_height > 0 ? spec.tile_height : lines;
  // Scan lines come as they are stored: to convert them OpenImageIO would reserve 64 MiB.
  const bool stored = spec.tile_width == 0 && spec.channelformats.empty();
  std::vector<float> values;
  std::vector<std::byte> bytes;
  for (int y = 0; y < spec.height; y += step) {
    const int rows = std::min(step, spec.height - y), top = spec.y + y;
    values.resize(row * static_cast<std::size_t>(rows));
    bool done = false;
    if (stored) {
      bytes.resize(values.size() * spec.format.size());
      done = in->read_native_scanlines(0, 0, top, top + rows, spec.z, begin, end, bytes.data()) &&
             OIIO::convert_pixel_values(spec.format, bytes.data(), OIIO::TypeDesc::FLOAT, values.data(),
                                        static_cast<int>(values.size()));
    } else if (spec.tile_width > 0) {
      done = in->read_tiles(0, 0, spec.x, spec.x + spec.width, top, top + rows, spec.z, spec.z + 1, begin,
                            end, OIIO::TypeDesc::FLOAT, values.data());
    } else {
      done =
          in->read_scanlines(0, 0, top, top + rows, spec.z, begin, end, OIIO::TypeDesc::FLOAT, values.data());
    }
    if (!done) return in->geterror();
    Image band = black_image(layout.width, rows, layout.channels);
    float* out = band.values.data();
    for (std::size_t pixel = 0; pixel < band.pixels(); ++pixel)
      for (const int channel : channels)
        *out++ = values[pixel * stride + static_cast<std::size_t>(channel - begin)];
    visit(std::move(band));
  }
  return {};
}

std::string encode_exr(const Image& image, std::vector<std::byte>& bytes) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (image.channels == 1) spec.channelnames = {"Y"};
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  OIIO::Filesystem::IOVecOutput memory;
  const auto out = OIIO::ImageOutput::create("image.exr", &memory);
  if (!out) return OIIO::geterror();
  if (!out->open("image.exr", spec) || !out->write_image(spec.format, image.values.data()) || !out->close())
    return out->geterror();
  const auto written = std::as_bytes(std::span(memory.buffer()));
  bytes.assign(written.begin(), written.end());
  return {};
}

}  // namespace

extern "C" const ImageCodec vitrail_image_codec;
const ImageCodec vitrail_image_codec{read, read_rows, encode_exr};

}  // namespace vitrail
