// SPDX-License-Identifier: Apache-2.0
// A TextureWriter writes a texture file row by row, so that no more than a row of tiles of each level is in
// memory.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "bundle/texture_file.h"

namespace vitrail {

// Rows of a level come from the top down, and levels in any order. The file is removed where the writer is
// destroyed before `finish`. Functions throw MachineError.
class TextureWriter {
 public:
  // `values` are the 256 values of the codes, where the format has codes.
  TextureWriter(std::filesystem::path file, const TextureFileInfo& info, CodeValues values = {});
  ~TextureWriter();
  TextureWriter(const TextureWriter&) = delete;
  TextureWriter& operator=(const TextureWriter&) = delete;

  // Adds the next row of the level, which is as wide as the level. Each texel is given by its words, or by
  // their first bytes where the file has fewer. The second function takes the bytes as they are in the file.
  void add_row(std::uint32_t level, std::span<const TexelWords> row);
  void add_row(std::uint32_t level, std::span<const std::byte> row);
  // Finishes the file, after the last row of the last level.
  WrittenTextureFile finish();

 private:
  struct Rows {
    std::uint32_t left = 0;        // to come
    std::vector<std::byte> bytes;  // of the row of tiles that is being filled, its top row first
  };
  void write_tiles(std::uint32_t level, std::uint32_t tile_y);
  void write(std::span<const std::byte> bytes, std::uint64_t offset);

  std::filesystem::path file_;
  TextureFileInfo info_;
  TextureFileLayout layout_;
  std::vector<Rows> rows_;                // of each level
  std::vector<std::uint64_t> checksums_;  // of each tile
  CodeValues values_;
  int descriptor_ = -1;
  bool finished_ = false;
};

}  // namespace vitrail
