// SPDX-License-Identifier: Apache-2.0
#include "film/exr_file.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

#include "film/picture_memory.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

static_assert(std::endian::native == std::endian::little, "the format is little-endian");

constexpr std::uint8_t zip = 3;       // the format's number of it
constexpr int compression_level = 4;  // of zlib; more takes twice the time for a few percent

// Appends what the format is made of.
class Writer {
 public:
  template <class T>
  void put(const T& value) {
    put_bytes(&value, sizeof value);
  }
  void put_bytes(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
  }
  void put_name(const std::string& name) { put_bytes(name.c_str(), name.size() + 1); }
  template <class... T>
  void put_attribute(const char* name, const char* type, const T&... values) {
    put_name(name);
    put_name(type);
    put(static_cast<std::int32_t>((sizeof values + ...)));
    (put(values), ...);
  }

  std::vector<std::byte> bytes;
};

void put_value(Writer& out, const char* name, const PictureFile::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    out.put_name(name);
    out.put_name("string");
    out.put(static_cast<std::int32_t>(text->size()));
    out.put_bytes(text->data(), text->size());
  }
  if (const auto* number = std::get_if<int>(&value)) out.put_attribute(name, "int", std::int32_t{*number});
  if (const auto* number = std::get_if<float>(&value)) out.put_attribute(name, "float", *number);
  if (const auto* matrix = std::get_if<std::array<float, 16>>(&value))
    out.put_attribute(name, "m44f", *matrix);
}

std::vector<std::size_t> sorted_channels(const PictureFile& picture) {
  std::vector<std::size_t> order(picture.channels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {},
                           [&](std::size_t c) -> const std::string& { return picture.channels[c].name; });
  return order;
}

void put_channels(Writer& out, const PictureFile& picture, std::span<const std::size_t> order) {
  Writer list;
  for (const std::size_t c : order) {
    const std::int32_t type = picture.channels[c].is_id ? 0 : 2;  // unsigned integers, floats
    list.put_name(picture.channels[c].name);
    list.put(type);
    list.put(std::uint32_t{0});  // not of perceptual encoding; reserved
    list.put(std::array<std::int32_t, 2>{1, 1});
  }
  list.put(std::uint8_t{0});
  out.put_name("channels");
  out.put_name("chlist");
  out.put(static_cast<std::int32_t>(list.bytes.size()));
  out.put_bytes(list.bytes.data(), list.bytes.size());
}

bool has_long_names(const PictureFile& picture) {
  constexpr std::size_t most = 31;
  return std::ranges::any_of(picture.channels, [](const auto& c) { return c.name.size() > most; }) ||
         std::ranges::any_of(picture.attributes, [](const auto& a) { return a.first.size() > most; });
}

void put_header(Writer& out, const PictureFile& picture, std::span<const std::size_t> order) {
  constexpr std::int32_t magic = 20000630, version = 2, long_names = 0x400;
  const std::array<std::int32_t, 4> data{picture.x, picture.y, picture.x + picture.width - 1,
                                         picture.y + picture.height - 1},
      display{0, 0, picture.full_width - 1, picture.full_height - 1};
  out.put(magic);
  out.put(version | (has_long_names(picture) ? long_names : 0));
  put_channels(out, picture, order);
  out.put_attribute("compression", "compression", zip);
  out.put_attribute("dataWindow", "box2i", data);
  out.put_attribute("displayWindow", "box2i", display);
  out.put_attribute("lineOrder", "lineOrder", std::uint8_t{0});  // downwards
  out.put_attribute("pixelAspectRatio", "float", 1.0f);
  out.put_attribute("screenWindowCenter", "v2f", 0.0f, 0.0f);
  out.put_attribute("screenWindowWidth", "float", 1.0f);
  for (const auto& [name, value] : picture.attributes)
    put_value(out, name == "DateTime" ? "capDate" : name == "Software" ? "software" : name.c_str(), value);
  out.put(std::uint8_t{0});
}

// Bytes of even places before those of odd ones, each as the difference to the one before it.
std::vector<std::uint8_t> rearranged(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::uint8_t> out(bytes.size());
  const std::size_t half = (bytes.size() + 1) / 2;
  for (std::size_t i = 0; i < bytes.size(); ++i) out[i % 2 * half + i / 2] = bytes[i];
  std::uint8_t before = out.empty() ? std::uint8_t{0} : out[0];
  for (std::size_t i = 1; i < out.size(); ++i) {
    const std::uint8_t now = out[i];
    out[i] = static_cast<std::uint8_t>(now - before + 128);
    before = now;
  }
  return out;
}

// Empty where it would not become smaller.
std::vector<std::uint8_t> compressed(const std::vector<std::uint8_t>& block) {
  const std::vector<std::uint8_t> source = rearranged(block);
  uLongf size = ::compressBound(static_cast<uLong>(source.size()));
  std::vector<std::uint8_t> out(size);
  if (::compress2(out.data(), &size, source.data(), static_cast<uLong>(source.size()), compression_level) !=
      Z_OK)
    throw MachineError("cannot write a picture: zlib failed");
  out.resize(size < block.size() ? size : 0);
  return out;
}

}  // namespace

ExrFile::ExrFile(const std::filesystem::path& file, const PictureFile& picture)
    : out_(file), order_(sorted_channels(picture)), y_(picture.y), height_(picture.height) {
  Writer header;
  put_header(header, picture, order_);
  table_ = header.bytes.size();
  const auto blocks = static_cast<std::size_t>((height_ + exr_block_rows - 1) / exr_block_rows);
  header.bytes.resize(table_ + blocks * sizeof offsets_[0]);
  out_.write(header.bytes);
}

void ExrFile::add_row(std::span<const std::uint32_t> pixels) {
  const std::size_t channels = order_.size(), first = block_.size();
  block_.reserve(static_cast<std::size_t>(std::min(exr_block_rows, height_)) * pixels.size_bytes());
  block_.resize(first + pixels.size_bytes());
  std::uint8_t* to = block_.data() + first;
  for (const std::size_t c : order_)
    for (std::size_t at = c; at < pixels.size(); at += channels, to += sizeof pixels[at])
      std::memcpy(to, &pixels[at], sizeof pixels[at]);
  ++rows_;
  if (rows_ % exr_block_rows == 0 || rows_ == height_) write_block();
}

void ExrFile::write_block() {
  const int first = (rows_ - 1) / exr_block_rows * exr_block_rows;
  const std::vector<std::uint8_t> smaller = compressed(block_);
  const std::vector<std::uint8_t>& bytes = smaller.empty() ? block_ : smaller;
  offsets_.push_back(out_.size());
  Writer begin;
  begin.put(std::int32_t{y_ + first});
  begin.put(static_cast<std::int32_t>(bytes.size()));
  out_.write(begin.bytes);
  out_.write(std::as_bytes(std::span(bytes)));
  block_.clear();
}

void ExrFile::commit() {
  out_.write_at(table_, std::as_bytes(std::span(offsets_)));
  out_.commit();
}

}  // namespace vitrail
