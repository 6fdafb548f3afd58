// SPDX-License-Identifier: Apache-2.0
#include "film/plain_exr.h"

#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>
#include <fmt/format.h>

#include <cstring>

#include "images/image_files.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

bool is_plain(const Imf::Channel& channel) {
  return channel.type != Imf::UINT && channel.xSampling == 1 && channel.ySampling == 1;
}

bool is_plain(const Imf::ChannelList& channels) {
  for (auto c = channels.begin(); c != channels.end(); ++c)
    if (!is_plain(c.channel())) return false;
  return channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
}

// Where the file has the attribute in the value's own type.
void take_attribute(const Imf::Header& header, const std::string& name, PictureFile::Value& value) {
  const char* called = name == "Software" ? "software" : name.c_str();
  if (float* number = std::get_if<float>(&value))
    if (const auto* found = header.findTypedAttribute<Imf::FloatAttribute>(called)) *number = found->value();
  if (int* number = std::get_if<int>(&value))
    if (const auto* found = header.findTypedAttribute<Imf::IntAttribute>(called)) *number = found->value();
  if (std::string* text = std::get_if<std::string>(&value))
    if (const auto* found = header.findTypedAttribute<Imf::StringAttribute>(called)) *text = found->value();
  if (auto* matrix = std::get_if<std::array<float, 16>>(&value))
    if (const auto* found = header.findTypedAttribute<Imf::M44fAttribute>(called))
      std::memcpy(matrix->data(), found->value().getValue(), sizeof *matrix);
}

void take_layout(const Imf::Header& header, PictureFile& picture) {
  const Imath::Box2i &data = header.dataWindow(), &display = header.displayWindow();
  picture.width = data.max.x - data.min.x + 1, picture.height = data.max.y - data.min.y + 1;
  picture.x = data.min.x, picture.y = data.min.y;
  picture.full_width = display.max.x - display.min.x + 1;
  picture.full_height = display.max.y - display.min.y + 1;
  picture.are_integers = false;
  picture.bits = 16;
  picture.channels.clear();
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    picture.channels.push_back({c.name(), false});
    if (c.channel().type == Imf::FLOAT) picture.bits = 32;
  }
  for (auto& [name, value] : picture.attributes) take_attribute(header, name, value);
}

std::vector<float> read_values(Imf::InputFile& in, const PictureFile& picture) {
  const std::size_t channels = picture.channels.size(), width = static_cast<std::size_t>(picture.width);
  std::vector<float> values(width * static_cast<std::size_t>(picture.height) * channels);
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < channels; ++c)
    frame.insert(picture.channels[c].name,
                 Imf::Slice::Make(Imf::FLOAT, values.data() + c, in.header().dataWindow(),
                                  channels * sizeof(float), channels * width * sizeof(float)));
  in.setFrameBuffer(frame);
  in.readPixels(picture.y, picture.y + picture.height - 1);
  return values;
}

}  // namespace

bool read_plain_exr(const std::filesystem::path& file, PictureFile& picture, std::vector<float>& values) {
  bool is_tiled = false, is_deep = false, is_multi_part = false;
  if (!Imf::isOpenExrFile(file.c_str(), is_tiled, is_deep, is_multi_part) || is_deep || is_multi_part)
    return false;
  try {
    Imf::Header::setMaxImageSize(max_image_extent, max_image_extent);
    Imf::InputFile in(file.c_str(), 0);
    if (!is_plain(in.header().channels())) return false;
    take_layout(in.header(), picture);
    if (static_cast<std::uint64_t>(picture.width) * static_cast<std::uint64_t>(picture.height) >
        most_image_pixels)
      throw Error(fmt::format("cannot read the image: it has more than {} pixels", most_image_pixels),
                  {file.string()});
    values = read_values(in, picture);
    return true;
  } catch (const Iex::BaseExc& e) {
    throw Error(fmt::format("cannot read the image: {}", e.what()), {file.string()});
  }
}

}  // namespace vitrail
