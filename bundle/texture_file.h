// SPDX-License-Identifier: Apache-2.0
// A texture file holds a baked image: its MIP levels, each in tiles that are read one by one.
// docs/why/textures.md has the byte layout and its reasons.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "bundle/features.h"
#include "bundle/texel.h"

namespace vitrail {

// Texel (0,0) of every level is the lower left one.
struct TextureFileInfo {
  TexelFormat format = TexelFormat::number;
  std::uint32_t width = 1, height = 1;  // of level 0
  std::uint32_t levels = 1;
  bool operator==(const TextureFileInfo&) const = default;
};

inline constexpr std::uint32_t texture_version = 2;
inline constexpr std::uint32_t max_texture_size = 1u << 20;

// A TextureLevel says where the tiles of one level are. Tiles stand row by row from the lower left corner;
// those at the right and upper edge are cut to the level.
struct TextureLevel {
  std::uint32_t width = 1, height = 1;
  std::uint32_t tiles_x = 1, tiles_y = 1;
  std::uint64_t first_tile = 0;  // counted over all levels
  std::uint64_t offset = 0;      // of its first byte in the file
};

// It holds the layout of an image and its levels, which is a function of the TextureFileInfo.
struct TextureFileLayout {
  std::vector<TextureLevel> levels;
  std::uint64_t tiles = 0;
  std::uint64_t file_bytes = 0;
};
TextureFileLayout texture_file_layout(const TextureFileInfo& info);

// Returns the number of levels down to one texel: each is half of the one before it, rounded down.
std::uint32_t texture_level_count(std::uint32_t width, std::uint32_t height);

// They are the 256 values that codes stand for; empty where the format has no codes.
using CodeValues = std::vector<float>;

// Writes the file. `texel(level, x, y)` gives the words of each texel, or the codes in the first bytes of a
// word: code i is worth i/255. Returns the hash of the file: that of its header, which holds the checksums of
// the tiles. Throws MachineError.
struct WrittenTextureFile {
  std::uint64_t bytes = 0, hash = 0;
  std::uint64_t read_bytes = 0;  // of its texels in memory, where they are codes; else 0
};
using TexelSource = std::function<TexelWords(std::uint32_t level, std::uint32_t x, std::uint32_t y)>;
WrittenTextureFile write_texture_file(const std::filesystem::path& file, const TextureFileInfo& info,
                                      const TexelSource& texel);

// A TextureFile has a header that has been verified; its tiles are verified when they are read.
class TextureFile {
 public:
  // Throws Error with the file's name where anything is wrong, MachineError where it cannot be opened.
  explicit TextureFile(std::filesystem::path file);

  const TextureFileInfo& info() const { return info_; }
  const TextureFileLayout& layout() const { return layout_; }
  std::uint64_t hash() const { return hash_; }
  const Features& features() const { return features_; }
  const CodeValues& values() const { return values_; }

  // Reads the words of a tile of `level`, row by row from the bottom; rows are `width` texels wide. Files
  // that were read last stay open; a scene may have any number. Codes of numbers are read as the numbers,
  // those of colours as is_color_code says. Throws Error. It is safe from many threads.
  struct Tile {
    std::uint32_t width = 0, height = 0;
    std::size_t words = 0;
  };
  Tile read_tile(std::uint32_t level, std::uint32_t tile_x, std::uint32_t tile_y,
                 std::span<std::uint32_t, max_tile_words> words) const;
  // Reads all tiles. Throws Error that says how many are wrong, and names one.
  void check_tiles() const;

 private:
  void expand(std::span<const std::byte> codes, std::span<std::uint32_t> words) const;

  std::filesystem::path file_;
  TextureFileInfo info_;
  TextureFileLayout layout_;
  std::vector<std::uint64_t> checksums_;  // a tile
  CodeValues values_;
  std::uint64_t hash_ = 0;
  Features features_;
};

}  // namespace vitrail
