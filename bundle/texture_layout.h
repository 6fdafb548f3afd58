// SPDX-License-Identifier: Apache-2.0
// This file has the bytes of a texture file, for the code that reads and writes it.
#pragma once

#include <span>

#include "bundle/texture_file.h"

namespace vitrail {

inline constexpr std::array<char, 8> texture_magic{'V', 'I', 'T', 'R', 'T', 'E', 'X', '\n'};

struct TextureHeader {
  std::array<char, 8> magic = texture_magic;
  std::uint32_t version = texture_version;
  TextureFileInfo info;
  std::uint32_t zero = 0;
  std::uint64_t file_bytes = 0;
  std::uint64_t tiles = 0;
  std::uint64_t checksum =
      0;              // of this header, with this field 0, the table of the tiles' checksums, and values
  Features features;  // codes, or none
};
static_assert(sizeof(TextureHeader) == 64);

// `values` are those of codes, which follow the table; they are empty where the format has no codes.
std::uint64_t header_checksum(TextureHeader header, std::span<const std::uint64_t> table,
                              std::span<const float> values);

// A TilePlace is the part of a tile that its level has, and where it is.
struct TilePlace {
  std::uint32_t width, height;
  std::uint64_t offset, bytes;
};
TilePlace place_of(TexelFormat format, const TextureLevel& level, std::uint32_t tile_x, std::uint32_t tile_y);

}  // namespace vitrail
