// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fstream>
#include <span>
#include <utility>

#include "images/codec_parts.h"
#include "images/radiance_header.h"

namespace vitrail {

namespace {

OIIO::TypeDesc type_of(const PictureFile& picture) {
  if (!picture.are_integers) return OIIO::TypeDesc::FLOAT;
  return picture.bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
}

void put(OIIO::ImageSpec& spec, const std::string& name, const PictureFile::Value& value) {
  if (const auto* matrix = std::get_if<std::array<float, 16>>(&value))
    spec.attribute(name, OIIO::TypeDesc::TypeMatrix, matrix->data());
  else if (const auto* text = std::get_if<std::string>(&value))
    spec.attribute(name, *text);
  else if (const auto* number = std::get_if<float>(&value))
    spec.attribute(name, *number);
  else
    spec.attribute(name, std::get<int>(value));
}

OIIO::ImageSpec spec_of(const PictureFile& picture) {
  OIIO::ImageSpec spec(picture.width, picture.height, static_cast<int>(picture.channels.size()),
                       type_of(picture));
  spec.x = picture.x, spec.y = picture.y;
  spec.full_x = spec.full_y = 0;
  spec.full_width = picture.full_width, spec.full_height = picture.full_height;
  spec.channelnames.clear();
  for (const PictureFile::Channel& channel : picture.channels) {
    spec.channelnames.push_back(channel.name);
    if (!picture.are_integers)
      spec.channelformats.push_back(channel.is_id ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT);
  }
  spec.alpha_channel = spec.z_channel = -1;
  for (const auto& [name, value] : picture.attributes) put(spec, name, value);
  return spec;
}

}  // namespace

RadianceHeader radiance_header_of(const OIIO::ImageInput& in, const std::string& file) {
  if (std::string_view(in.format_name()) != "hdr") return {};
  constexpr std::size_t most = 1 << 16;
  std::string head(most, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return radiance_header(head);
}

std::string encode_picture(const std::string& file, const PictureFile& picture, const void* pixels,
                           std::vector<std::byte>& bytes) {
  const OIIO::ImageSpec spec = spec_of(picture);
  // Unknown: of each channel its own.
  const OIIO::TypeDesc format = picture.are_integers ? spec.format : OIIO::TypeDesc(OIIO::TypeDesc::UNKNOWN);
  OIIO::Filesystem::IOVecOutput memory;
  const auto out = OIIO::ImageOutput::create(file, &memory);
  if (!out) return OIIO::geterror();
  if (!out->open(file, spec) || !out->write_image(format, pixels) || !out->close()) return out->geterror();
  const auto written = std::as_bytes(std::span(memory.buffer()));
  bytes.assign(written.begin(), written.end());
  return {};
}

std::string decode_picture(const std::string& file, PictureFile& picture, std::vector<float>& values) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in) return OIIO::geterror();
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.depth > 1) return "volumes are not images";
  values.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) return in->geterror();
  picture.width = spec.width, picture.height = spec.height;
  picture.x = spec.x, picture.y = spec.y;
  picture.full_width = spec.full_width, picture.full_height = spec.full_height;
  const RadianceHeader radiance = radiance_header_of(*in, file);
  undo(radiance, values, picture.width, picture.height, spec.nchannels);
  if (radiance.is_transposed) std::swap(picture.full_width, picture.full_height);
  picture.are_integers = !spec.format.is_floating_point();
  picture.bits = static_cast<int>(8 * spec.format.size());
  picture.channels.clear();
  for (int c = 0; c < spec.nchannels; ++c)
    picture.channels.push_back({spec.channel_name(c), spec.channelformat(c) == OIIO::TypeDesc::UINT32});
  for (auto& [name, value] : picture.attributes) {
    if (float* number = std::get_if<float>(&value)) *number = spec.get_float_attribute(name, *number);
    if (int* number = std::get_if<int>(&value)) *number = spec.get_int_attribute(name, *number);
    if (std::string* text = std::get_if<std::string>(&value)) *text = spec.get_string_attribute(name, *text);
    if (auto* matrix = std::get_if<std::array<float, 16>>(&value))
      spec.getattribute(name, OIIO::TypeDesc::TypeMatrix, matrix->data());
  }
  return {};
}

}  // namespace vitrail
