// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "bundle/texture_file.h"

namespace vitrail {

// Memory for tiles, a fixed number of slots of 16 KiB, given to the tiles in use by the clock algorithm.
// Reading takes no lock: a reader copies the texels that it wants and then checks that the slot has not been
// given away meanwhile (Lameter 2005: sequence locks); if it has, it reads the file.
class TileCache {
 public:
  // At least one slot. Memory is taken from the system when it is first used.
  explicit TileCache(std::uint64_t budget_bytes);
  ~TileCache();
  TileCache(const TileCache&) = delete;
  TileCache& operator=(const TileCache&) = delete;

  // Where a tile of an image is: one of these a tile, 0 where it is not in memory.
  using Entry = std::atomic<std::uint64_t>;

  // Copies into out[i] the `words_per_texel` words from index[i]·words_per_texel on, of the tile of `file` at
  // `entry`. Throws Error for a damaged tile.
  struct Tile {
    const TextureFile& file;
    Entry& entry;
    std::uint32_t level, x, y;
  };
  void read(const Tile& tile, std::span<const std::uint32_t> texels, TexelWords* out);

  std::uint64_t tile_loads() const { return loads_.load(std::memory_order_relaxed); }
  std::uint64_t resident_bytes() const { return resident_.load(std::memory_order_relaxed); }
  std::uint64_t budget_bytes() const { return slot_count_ * slot_bytes; }

  static constexpr std::uint64_t slot_bytes = max_tile_words * sizeof(std::uint32_t);

 private:
  struct Slot {
    std::atomic<std::uint32_t> sequence{0};  // counts the tiles it has held
    std::atomic<std::uint32_t> used{0};      // since the clock's hand passed
  };
  bool read_resident(std::uint64_t entry, std::uint32_t words, std::span<const std::uint32_t> texels,
                     TexelWords* out);
  void store(Entry& entry, std::span<const std::uint32_t> words);

  std::uint64_t slot_count_;
  std::unique_ptr<Slot[]> slots_;
  std::atomic<std::uint32_t>* words_ = nullptr;
  std::mutex mutex_;  // of what follows, and of all writing to slots
  std::uint64_t hand_ = 0;
  std::atomic<std::uint64_t> loads_{0}, resident_{0};
};

}  // namespace vitrail
