// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>

#include "bundle/reflectances/reflectance_fitter.h"
#include "bundle/texture_file.h"

namespace vitrail {

// A TileCache is memory for tiles: a fixed number of slots of 16 KiB, given to the tiles in use by the clock
// algorithm. Reading takes no lock (a sequence lock a slot, Lameter 2005). A reader copies the texels that it
// wants and then looks whether the slot has been given away meanwhile. If so, it reads the file.
//
// A file of colour codes is read into texels of spectra that are still to be found: each is found when it is
// first looked up (`convert`), and kept if no other thread is writing.
class TileCache {
 public:
  // It has at least one slot. The system gives the memory when it is first used. Throws MachineError.
  explicit TileCache(std::uint64_t budget_bytes);
  ~TileCache();
  TileCache(const TileCache&) = delete;
  TileCache& operator=(const TileCache&) = delete;

  // It says where a tile of an image is: slot (upper half) and the slot's sequence number then. 0: nowhere.
  using Entry = std::atomic<std::uint64_t>;

  struct Tile {
    const TextureFile& file;
    Entry& entry;
    TexelFormat format;  // as it is read
    std::uint32_t level, x, y;
  };
  // The words of some texels go here: word w of texel i to first[(3·i + w)·stride].
  struct Words {
    std::uint32_t* first;
    std::size_t stride = 1;
    std::uint32_t& operator()(std::size_t texel, std::size_t word) const {
      return first[(3 * texel + word) * stride];
    }
  };
  // Copies the words of the texels with these indices, row by row in the tile. Colours whose spectra are
  // still to be found are replaced by the spectra, in the cache too. Throws Error for a damaged tile.
  template <std::size_t N>
  void read(const Tile& tile, const std::array<std::uint32_t, N>& texels, const Words& out) {
    read_as_kept(tile, texels, out);
    const std::uint32_t last = words_per_texel(tile.format) - 1;
    if (last == 0) return;
    std::uint32_t either = 0;
    for (std::size_t i = 0; i < N; ++i) either |= out(i, last);
    if (is_color_code(either) && finds_spectra(tile.file.info().format)) convert(tile, texels, out);
  }

  // Does the same, but colours whose spectra are still to be found stay as they are (coded_color).
  template <std::size_t N>
  void read_as_kept(const Tile& tile, const std::array<std::uint32_t, N>& texels, const Words& out) {
    if (!read_resident(tile, texels, out)) read_and_store(tile, texels, out);
  }

  std::uint64_t tile_loads() const { return loads_.load(std::memory_order_relaxed); }
  std::uint64_t resident_bytes() const { return resident_.load(std::memory_order_relaxed); }
  std::uint64_t budget_bytes() const { return slot_count_ * slot_bytes; }

  static constexpr std::uint64_t slot_bytes = max_tile_words * sizeof(std::uint32_t);

 private:
  struct Slot {
    std::atomic<std::uint32_t> sequence;  // of the tile in it, counted from 1; 0: it never held one
    std::atomic<std::uint32_t> used;      // since the clock's hand was there
  };

  bool is_resident(std::uint64_t entry) const;
  template <std::size_t N>
  bool read_resident(const Tile& tile, const std::array<std::uint32_t, N>& texels, const Words& out) {
    const std::uint64_t entry = tile.entry.load(std::memory_order_acquire);
    if (entry == 0) return false;
    Slot& slot = slots_[entry >> 32];
    const std::atomic<std::uint32_t>* const words = words_ + (entry >> 32) * max_tile_words;
    switch (words_per_texel(tile.format)) {
      case 1:
        copy<1>(words, texels, out);
        break;
      case 2:
        copy<2>(words, texels, out);
        break;
      default:
        copy<3>(words, texels, out);
    }
    if (slot.sequence.load(std::memory_order_relaxed) != static_cast<std::uint32_t>(entry)) return false;
    if (slot.used.load(std::memory_order_relaxed) == 0) slot.used.store(1, std::memory_order_relaxed);
    return true;
  }
  template <std::uint32_t WordsEach, std::size_t N>
  static void copy(const std::atomic<std::uint32_t>* from, const std::array<std::uint32_t, N>& texels,
                   const Words& out) {
    for (std::size_t i = 0; i < N; ++i) {
      const std::atomic<std::uint32_t>* const texel = from + std::size_t{texels[i]} * WordsEach;
      [&]<std::uint32_t... W>(std::integer_sequence<std::uint32_t, W...>) {
        ((out(i, WordsEach - 1 - W) = texel[WordsEach - 1 - W].load(std::memory_order_acquire)), ...);
      }
      (std::make_integer_sequence<std::uint32_t, WordsEach>());
    }
  }
  void read_and_store(const Tile& tile, std::span<const std::uint32_t> texels, const Words& out);
  void store(Entry& entry, std::span<const std::uint32_t> words);
  void convert(const Tile& tile, std::span<const std::uint32_t> texels, const Words& out);

  std::uint64_t slot_count_;
  Slot* slots_ = nullptr;
  std::atomic<std::uint32_t>* words_ = nullptr;
  ReflectanceFitter fitter_;
  std::mutex mutex_;        // of the hand, and of all writing to slots
  std::uint64_t hand_ = 0;  // the slot that is considered next
  std::atomic<std::uint64_t> loads_{0}, resident_{0};
};

}  // namespace vitrail
