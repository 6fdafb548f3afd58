// SPDX-License-Identifier: Apache-2.0
#include "images/image_files.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>

#include "scene/atomic_file.h"
#include "scene/color.h"
#include "scene/diagnostics.h"

namespace vitrail {

namespace {

// The channels R, G and B by name, else the first three; the first alone of a picture with fewer.
std::vector<int> color_channels(const OIIO::ImageSpec& spec) {
  const std::vector<int> named{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (*std::min_element(named.begin(), named.end()) >= 0) return named;
  if (spec.nchannels >= 3) return {0, 1, 2};
  return {0};
}

std::unique_ptr<OIIO::ImageInput> opened(const std::filesystem::path& file) {
  auto in = OIIO::ImageInput::open(file.string());
  if (!in) throw Error(fmt::format("cannot read the image: {}", OIIO::geterror()), {file.string()});
  if (in->spec().depth > 1) throw Error("volumes are not images", {file.string()});
  return in;
}

}  // namespace

ImageLayout read_image_layout(const std::filesystem::path& file) {
  const auto in = opened(file);
  const OIIO::ImageSpec& spec = in->spec();
  return {spec.width, spec.height, static_cast<int>(color_channels(spec).size()),
          !spec.format.is_floating_point()};
}

StoredImage read_stored_image(const std::filesystem::path& file) {
  const auto in = opened(file);
  const OIIO::ImageSpec& spec = in->spec();
  std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    throw Error(fmt::format("cannot read the image: {}", in->geterror()), {file.string()});
  const std::vector<int> channels = color_channels(spec);
  StoredImage stored{black_image(spec.width, spec.height, static_cast<int>(channels.size())),
                     !spec.format.is_floating_point()};
  float* out = stored.image.values.data();
  for (std::size_t pixel = 0; pixel < stored.image.pixels(); ++pixel)
    for (const int channel : channels)
      *out++ = values[pixel * static_cast<std::size_t>(spec.nchannels) + static_cast<std::size_t>(channel)];
  return stored;
}

Image read_linear_image(const std::filesystem::path& file) {
  StoredImage stored = read_stored_image(file);
  if (stored.integer)
    for (float& value : stored.image.values)
      value = static_cast<float>(srgb_decode(static_cast<double>(value)));
  return std::move(stored.image);
}

void write_exr_image(const std::filesystem::path& file, const Image& image) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (image.channels == 1) spec.channelnames = {"Y"};
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  OIIO::Filesystem::IOVecOutput memory;
  const auto out = OIIO::ImageOutput::create(file.string(), &memory);
  if (!out || !out->open(file.string(), spec) || !out->write_image(spec.format, image.values.data()) ||
      !out->close())
    throw MachineError(
        fmt::format("cannot write {}: {}", file.string(), out ? out->geterror() : OIIO::geterror()));
  AtomicFile target(file);
  target.write(std::as_bytes(std::span(memory.buffer())));
  target.commit();
}

}  // namespace vitrail
