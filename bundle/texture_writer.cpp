// SPDX-License-Identifier: Apache-2.0
#include "bundle/texture_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "bundle/checksum.h"
#include "bundle/texture_layout.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

TextureWriter::TextureWriter(std::filesystem::path file, const TextureFileInfo& info, CodeValues values)
    : file_(std::move(file)),
      info_(info),
      layout_(texture_file_layout(info)),
      checksums_(layout_.tiles),
      values_(std::move(values)) {
  if (values_.size() != (is_coded(info.format) ? code_count : 0))
    throw std::logic_error("a texture file of codes has 256 values, another none");
  for (const TextureLevel& level : layout_.levels) rows_.push_back({level.height, {}});
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0)
    throw MachineError(fmt::format("cannot create {}: {}", file_.string(), std::strerror(errno)));
}

TextureWriter::~TextureWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!finished_) ::unlink(file_.c_str());
}

void TextureWriter::add_row(std::uint32_t level, std::span<const TexelWords> row) {
  const std::size_t each = bytes_per_texel(info_.format);
  std::vector<std::byte> bytes(row.size() * each);
  for (std::size_t x = 0; x < row.size(); ++x) std::memcpy(&bytes[x * each], row[x].data(), each);
  add_row(level, bytes);
}

void TextureWriter::add_row(std::uint32_t level, std::span<const std::byte> row) {
  Rows& rows = rows_.at(level);
  rows.bytes.insert(rows.bytes.end(), row.begin(), row.end());
  --rows.left;
  if (rows.left % tile_height(info_.format) == 0) write_tiles(level, rows.left / tile_height(info_.format));
}

void TextureWriter::write_tiles(std::uint32_t level, std::uint32_t tile_y) {
  const TextureLevel& of = layout_.levels[level];
  std::vector<std::byte>& from = rows_[level].bytes;
  const std::size_t each = bytes_per_texel(info_.format), row = of.width * each;
  const std::size_t height = from.size() / row;
  std::vector<std::byte> tiles;  // that follow each other in the file
  tiles.reserve(from.size());
  for (std::uint32_t tile_x = 0; tile_x < of.tiles_x; ++tile_x) {
    const TilePlace place = place_of(info_.format, of, tile_x, tile_y);
    const std::size_t first = tiles.size(), left = std::size_t{tile_x} * tile_width(info_.format) * each;
    for (std::size_t y = height; y-- > 0;) {
      const auto begin = from.begin() + static_cast<std::ptrdiff_t>(y * row + left);
      tiles.insert(tiles.end(), begin, begin + static_cast<std::ptrdiff_t>(place.width * each));
    }
    checksums_[of.first_tile + std::uint64_t{tile_y} * of.tiles_x + tile_x] =
        checksum(std::span(tiles).subspan(first));
  }
  write(tiles, place_of(info_.format, of, 0, tile_y).offset);
  from.clear();
}

void TextureWriter::write(std::span<const std::byte> bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw MachineError(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
    bytes = bytes.subspan(static_cast<std::size_t>(n));
    offset += static_cast<std::uint64_t>(n);
  }
}

WrittenTextureFile TextureWriter::finish() {
  for (const Rows& rows : rows_)
    if (rows.left > 0) throw std::logic_error("a texture file lacks rows");
  TextureHeader header;
  header.info = info_;
  header.file_bytes = layout_.file_bytes;
  header.tiles = layout_.tiles;
  const bool codes = read_format(info_.format) != info_.format;
  if (codes) header.features.required = required_feature::codes;
  header.checksum = header_checksum(header, checksums_, values_);
  write(std::as_bytes(std::span(&header, 1)), 0);
  write(std::as_bytes(std::span(checksums_)), sizeof header);
  write(std::as_bytes(std::span(values_)), sizeof header + checksums_.size() * sizeof(std::uint64_t));
  if (::close(std::exchange(descriptor_, -1)) != 0)
    throw MachineError(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
  finished_ = true;
  std::uint64_t texels = 0;
  for (const TextureLevel& level : layout_.levels) texels += std::uint64_t{level.width} * level.height;
  return {layout_.file_bytes, header.checksum, codes ? texels * 4 * words_per_texel(info_.format) : 0};
}

WrittenTextureFile write_texture_file(const std::filesystem::path& file, const TextureFileInfo& info,
                                      const TexelSource& texel) {
  CodeValues values(is_coded(info.format) ? code_count : 0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) / (code_count - 1);
  TextureWriter writer(file, info, std::move(values));
  std::vector<TexelWords> row;
  for (std::uint32_t level = 0; level < info.levels; ++level) {
    row.resize(std::max(info.width >> level, 1u));
    for (std::uint32_t y = std::max(info.height >> level, 1u); y-- > 0;) {
      for (std::uint32_t x = 0; x < row.size(); ++x) row[x] = texel(level, x, y);
      writer.add_row(level, row);
    }
  }
  return writer.finish();
}

}  // namespace vitrail
