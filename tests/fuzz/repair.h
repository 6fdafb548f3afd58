// SPDX-License-Identifier: Apache-2.0
// Files whose checksums are put right, as far as they say where their parts are: what the checksums cover is
// looked at.
#pragma once

#include <cstring>
#include <vector>

#include "bundle/checksum.h"
#include "bundle/domain_file.h"
#include "bundle/domain_layout.h"
#include "bundle/texture_layout.h"

namespace vitrail::fuzz {

template <class T>
T at(const std::vector<std::byte>& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, &bytes[offset], sizeof value);
  return value;
}

template <class T>
void put(std::vector<std::byte>& bytes, std::size_t offset, const T& value) {
  std::memcpy(&bytes[offset], &value, sizeof value);
}

// Returns what the manifest has as its hash.
inline std::uint64_t repair_domain(std::vector<std::byte>& bytes) {
  if (bytes.size() < sizeof(layout::DomainHeader)) return 0;
  auto header = at<layout::DomainHeader>(bytes, 0);
  const std::uint64_t header_bytes = layout::header_bytes(header.sections);
  if (header.sections > layout::most_sections || header_bytes > bytes.size()) return 0;
  for (std::size_t i = 0; i < header.sections; ++i) {
    const std::size_t place = sizeof header + i * sizeof(layout::Section);
    auto section = at<layout::Section>(bytes, place);
    if (section.offset > bytes.size() || section.count > bytes.size() || section.element_size > 4096)
      continue;
    const std::uint64_t size = layout::padded_bytes(section.count, section.element_size);
    if (size > bytes.size() - section.offset) continue;
    section.checksum = checksum(std::span(bytes).subspan(section.offset, size));
    put(bytes, place, section);
  }
  header.file_bytes = bytes.size();
  header.header_checksum =
      layout::checksum_of(header, std::span(bytes).subspan(sizeof header, header_bytes - sizeof header));
  put(bytes, 0, header);
  return header.header_checksum;
}

// The same of a texture: of each tile that is in the file, and of the header with its table.
inline std::uint64_t repair_texture(std::vector<std::byte>& bytes) {
  if (bytes.size() < sizeof(TextureHeader)) return 0;
  auto header = at<TextureHeader>(bytes, 0);
  const TextureFileInfo& info = header.info;
  constexpr std::uint32_t most = 1 << 10;
  if (static_cast<std::uint32_t>(info.format) >= texel_format_count || info.width < 1 || info.width > most ||
      info.height < 1 || info.height > most || info.levels < 1 ||
      info.levels > texture_level_count(info.width, info.height))
    return 0;
  const TextureFileLayout layout = texture_file_layout(info);
  header.tiles = layout.tiles;
  header.file_bytes = layout.file_bytes;
  bytes.resize(layout.file_bytes);
  std::vector<std::uint64_t> table;
  for (const TextureLevel& level : layout.levels)
    for (std::uint32_t y = 0; y < level.tiles_y; ++y)
      for (std::uint32_t x = 0; x < level.tiles_x; ++x) {
        const TilePlace place = place_of(info.format, level, x, y);
        table.push_back(checksum(std::span(bytes).subspan(place.offset, place.bytes)));
      }
  std::memcpy(&bytes[sizeof header], table.data(), table.size() * sizeof table[0]);
  std::vector<float> values(is_coded(info.format) ? code_count : 0);
  std::memcpy(values.data(), &bytes[sizeof header + table.size() * sizeof table[0]],
              values.size() * sizeof(float));
  header.checksum = header_checksum(header, table, values);
  put(bytes, 0, header);
  return header.checksum;
}

}  // namespace vitrail::fuzz
