// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string_view>

#include "images/codec_parts.h"
#include "images/radiance_header.h"

namespace vitrail {

namespace {

// Kinds of files whose pixels tests hold to known ones (tests/images/image_kinds_test.cpp). OpenImageIO opens
// others too: videos, volumes, depths, files that need not be there, and Softimage's, whose uncompressed
// pixels it leaves as its memory was.
constexpr std::array known_kinds{"bmp", "dds", "dpx",  "fits",  "gif",      "hdr",     "heif",
                                 "ico", "iff", "jpeg", "png",   "jpeg2000", "openexr", "pnm",
                                 "psd", "rla", "sgi",  "targa", "tiff",     "webp"};

// Why nothing can be made of it, or nothing.
std::string fault_of(const OIIO::ImageInput& in) {
  const OIIO::ImageSpec& spec = in.spec();
  if (std::ranges::find(known_kinds, std::string_view(in.format_name())) == known_kinds.end())
    return std::string("files of the kind \"") + in.format_name() + "\" are not read as pictures";
  if (spec.deep) return "deep images have many values a pixel";
  if (spec.depth > 1) return "volumes are not images";
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) return "its header is damaged";
  return {};
}

// An empty text would mean that all is well.
std::string reason(const std::string& said) { return said.empty() ? "OpenImageIO does not say why" : said; }

// −1 where there is none. The library's own search aborts where there are fewer names than channels (FITS).
int channel_named(std::string_view name, const OIIO::ImageSpec& spec) {
  for (std::size_t c = 0; c < spec.channelnames.size() && static_cast<int>(c) < spec.nchannels; ++c)
    if (spec.channelnames[c] == name) return static_cast<int>(c);
  return -1;
}

// The library has that of GIF beyond the last channel.
int alpha_of(const OIIO::ImageSpec& spec) {
  return spec.alpha_channel < spec.nchannels ? spec.alpha_channel : channel_named("A", spec);
}

// The channels R, G and B by name, else the first three; the first alone of a picture with fewer. After them
// alpha, where there is one.
std::vector<int> channels_of(const OIIO::ImageSpec& spec) {
  std::vector<int> channels;
  for (const char* name : {"R", "G", "B"}) channels.push_back(channel_named(name, spec));
  if (*std::min_element(channels.begin(), channels.end()) < 0)
    channels = spec.nchannels >= 3 ? std::vector{0, 1, 2} : std::vector{0};
  const int alpha = alpha_of(spec);
  if (alpha >= 0 && std::find(channels.begin(), channels.end(), alpha) == channels.end())
    channels.push_back(alpha);
  return channels;
}

bool are_integers(const std::vector<int>& channels, const OIIO::ImageSpec& spec) {
  return std::ranges::none_of(channels, [&](int c) { return spec.channelformat(c).is_floating_point(); });
}

// OpenImageIO 2.4 multiplies alpha into the colours of WebP, whatever it is asked for.
bool is_multiplied(const OIIO::ImageInput& in) {
  return std::string_view(in.format_name()) == "webp" && alpha_of(in.spec()) >= 0 &&
         in.spec().get_int_attribute("oiio:UnassociatedAlpha") == 0;
}

void divide_by_alpha(Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t at = 0; at < image.values.size(); at += channels) {
    const float alpha = image.values[at + channels - 1];
    for (std::size_t c = 0; c + 1 < channels && alpha > 0; ++c)
      image.values[at + c] = std::min(1.0f, image.values[at + c] / alpha);
  }
}

// Of pixels of `stride` values, the first of which is the file's channel `first`.
Image taken(const std::vector<float>& values, std::size_t stride, int first, const std::vector<int>& channels,
            int width, int rows) {
  Image image = black_image(width, rows, static_cast<int>(channels.size()));
  float* out = image.values.data();
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel)
    for (const int channel : channels)
      *out++ = values[pixel * stride + static_cast<std::size_t>(channel - first)];
  return image;
}

std::optional<Chromaticities> chromaticities_of(const OIIO::ImageSpec& spec) {
  std::array<float, 8> v{};
  if (!spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), v.data())) return {};
  return Chromaticities{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}};
}

// Rows of tiles, or as many scan lines as take about so much.
constexpr std::size_t band_bytes = std::size_t{4} << 20;

// OpenImageIO has room for so much where it converts scan lines.
constexpr std::uint64_t most_converted_bytes = 64 << 20;

// Readers of these, and of PNG that is interlaced, decode the whole picture before they give a row of it.
bool is_decoded_whole(const OIIO::ImageInput& in) {
  constexpr std::array by_rows{"dpx", "fits", "hdr", "jpeg", "openexr", "png", "pnm", "rla"};
  return std::ranges::find(by_rows, std::string_view(in.format_name())) == by_rows.end() ||
         in.spec().get_int_attribute("png:interlaced") != 0;
}

// What reading takes: `decoded` by the library, the floats of channels, and the picture.
void note_memory(const OIIO::ImageInput& in, ImageLayout& layout) {
  const OIIO::ImageSpec& spec = in.spec();
  const std::uint64_t stored = spec.image_bytes(true), pixels = spec.image_pixels();
  const std::uint64_t channels =
      static_cast<std::uint64_t>(spec.nchannels) + static_cast<std::uint64_t>(layout.channels);
  const std::uint64_t floats = pixels * channels * sizeof(float);
  const std::uint64_t decoded = is_decoded_whole(in) ? 2 * stored : 0;
  const auto lines = static_cast<std::uint64_t>(std::max(spec.tile_height, 1));
  const std::uint64_t row = spec.height > 0 ? (floats + stored) / static_cast<std::uint64_t>(spec.height) : 0;
  layout.whole_bytes = decoded + std::min(stored, most_converted_bytes) + floats;
  layout.rows_bytes =
      decoded + std::min(floats + stored, std::max<std::uint64_t>(4 * band_bytes, lines * row));
}

// A picture that is open, with the bytes that it is read from where it has no file.
class OpenPicture {
 public:
  // Colours are as stored: OpenImageIO would multiply alpha into them.
  explicit OpenPicture(const PictureSource& source) {
    OIIO::ImageSpec wanted;
    wanted.attribute("oiio:UnassociatedAlpha", 1);
    if (!source.bytes.empty()) {
      memory_ = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::byte*>(source.bytes.data()),
                                                                source.bytes.size());
      OIIO::Filesystem::IOProxy* proxy = memory_.get();
      wanted.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    }
    in_ = OIIO::ImageInput::open(source.file, &wanted);
    if (in_ && source.bytes.empty()) radiance_ = radiance_header_of(*in_, source.file);
  }
  explicit operator bool() const { return in_ != nullptr; }
  OIIO::ImageInput& operator*() const { return *in_; }
  OIIO::ImageInput* operator->() const { return in_.get(); }
  const RadianceHeader& radiance() const { return radiance_; }

 private:
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory_;  // outlives what reads it
  std::unique_ptr<OIIO::ImageInput> in_;
  RadianceHeader radiance_;
};

std::string read_picture(const PictureSource& source, ImageLayout& layout, Image* image) {
  const OpenPicture in(source);
  if (!in) return reason(OIIO::geterror());
  if (std::string fault = fault_of(*in); !fault.empty()) return fault;
  const OIIO::ImageSpec& spec = in->spec();
  const std::vector<int> channels = channels_of(spec);
  layout = {spec.width, spec.height, static_cast<int>(channels.size()), are_integers(channels, spec),
            chromaticities_of(spec)};
  note_memory(*in, layout);
  const RadianceHeader& radiance = in.radiance();
  if (radiance.is_turned()) layout.whole_bytes *= 2, layout.rows_bytes = layout.whole_bytes;
  if (radiance.is_transposed) std::swap(layout.width, layout.height);
  if (!image) return {};
  const auto stride = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> values(spec.image_pixels() * stride);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    return reason(in->geterror());
  *image = taken(values, stride, 0, channels, spec.width, spec.height);
  undo(radiance, image->values, image->width, image->height, image->channels);
  if (is_multiplied(*in)) divide_by_alpha(*image);
  return {};
}

std::string read_picture_rows(const PictureSource& source, ImageLayout& layout,
                              const std::function<void(Image)>& visit) {
  if (std::string problem = read_picture(source, layout, nullptr); !problem.empty()) return problem;
  const OpenPicture in(source);
  if (!in) return reason(OIIO::geterror());
  if (in.radiance().is_turned()) {
    Image whole;
    if (std::string problem = read_picture(source, layout, &whole); !problem.empty()) return problem;
    visit(std::move(whole));
    return {};
  }
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
    if (!done) return reason(in->geterror());
    Image band = taken(values, stride, begin, channels, layout.width, rows);
    undo(in.radiance(), band.values, band.width, band.height, band.channels);
    if (is_multiplied(*in)) divide_by_alpha(band);
    visit(std::move(band));
  }
  return {};
}

// Exceptions of the library say what is wrong with a file; lack of memory, and what `visit` throws, pass.
std::string read(const PictureSource& source, ImageLayout& layout, Image* image) {
  try {
    return read_picture(source, layout, image);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::string read_rows(const PictureSource& source, ImageLayout& layout,
                      const std::function<void(Image)>& visit) {
  bool is_of_visit = false;
  try {
    return read_picture_rows(source, layout, [&](Image rows) {
      is_of_visit = true;
      visit(std::move(rows));
      is_of_visit = false;
    });
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (is_of_visit) throw;
    return error.what();
  }
}

// It makes its list of formats, and its threads.
void begin() { OIIO::ImageInput::create("none.png"); }

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
const ImageCodec vitrail_image_codec{begin,          read,           read_rows, encode_exr,
                                     encode_picture, decode_picture, map_tones};

}  // namespace vitrail
