// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/tile_cache.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "bundle/reflectances/color_words.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Of all slots together: what is not used costs only addresses.
constexpr std::uint64_t most_bytes = 1ull << 40;

void* reserve(std::uint64_t bytes) {
  void* const memory =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED)
    throw MachineError(fmt::format("no {} bytes for textures: {}", bytes, std::strerror(errno)));
  return memory;
}

}  // namespace

TileCache::TileCache(std::uint64_t budget_bytes)
    : slot_count_(std::clamp(budget_bytes, slot_bytes, most_bytes) / slot_bytes) {
  // Fresh pages are zero, which is the state of a slot that never held a tile.
  slots_ = static_cast<Slot*>(reserve(slot_count_ * sizeof(Slot)));
  try {
    words_ = static_cast<std::atomic<std::uint32_t>*>(reserve(slot_count_ * slot_bytes));
  } catch (...) {
    ::munmap(slots_, slot_count_ * sizeof(Slot));
    throw;
  }
}

TileCache::~TileCache() {
  ::munmap(slots_, slot_count_ * sizeof(Slot));
  ::munmap(words_, slot_count_ * slot_bytes);
}

void TileCache::read_and_store(const Tile& tile, std::span<const std::uint32_t> texels, const Words& out) {
  std::array<std::uint32_t, max_tile_words> words;
  const TextureFile::Tile read = tile.file.read_tile(tile.level, tile.x, tile.y, words);
  loads_.fetch_add(1, std::memory_order_relaxed);
  const std::uint32_t count = words_per_texel(tile.file.info().format);
  for (std::size_t i = 0; i < texels.size(); ++i)
    for (std::uint32_t w = 0; w < count; ++w) out(i, w) = words[texels[i] * count + w];
  store(tile.entry, std::span(words).first(read.words));
}

// The release stores keep the order: the slot is taken away, written, then offered. A reader's acquire loads
// of the words come before its second look at the sequence.
void TileCache::store(Entry& entry, std::span<const std::uint32_t> words) {
  const std::lock_guard lock(mutex_);
  if (is_resident(entry.load(std::memory_order_relaxed))) return;  // another thread was faster
  while (slots_[hand_].used.exchange(0, std::memory_order_relaxed) != 0) hand_ = (hand_ + 1) % slot_count_;
  const std::uint64_t index = hand_;
  hand_ = (hand_ + 1) % slot_count_;
  Slot& slot = slots_[index];
  const std::uint32_t last = slot.sequence.load(std::memory_order_relaxed);
  if (last == 0) resident_.fetch_add(slot_bytes, std::memory_order_relaxed);
  const std::uint32_t sequence = last == 0xffffffffu ? 1 : last + 1;
  slot.sequence.store(sequence, std::memory_order_relaxed);
  std::atomic<std::uint32_t>* const to = words_ + index * max_tile_words;
  for (std::size_t i = 0; i < words.size(); ++i) to[i].store(words[i], std::memory_order_release);
  slot.used.store(1, std::memory_order_relaxed);
  entry.store(index << 32 | sequence, std::memory_order_release);
}

// A reader loads the last word first: where it is of a spectrum, so are those before it, which were stored
// before it. Threads that convert the same code store the same.
void TileCache::convert(const Tile& tile, std::span<const std::uint32_t> texels, const Words& out) {
  const TexelFormat of_file = tile.file.info().format;
  const std::size_t count = words_per_texel(tile.format);
  std::array<bool, 4> converted{};
  for (std::size_t i = 0; i < texels.size(); ++i) {
    if (!is_color_code(out(i, count - 1))) continue;
    TexelWords words{};
    for (std::size_t w = 0; w < count; ++w) words[w] = out(i, w);
    words = found_words(of_file, words, tile.file.values(), fitter_);
    for (std::size_t w = 0; w < count; ++w) out(i, w) = words[w];
    converted.at(i) = true;
  }
  const std::unique_lock lock(mutex_, std::try_to_lock);
  const std::uint64_t entry = tile.entry.load(std::memory_order_relaxed);
  if (!lock || !is_resident(entry)) return;
  std::atomic<std::uint32_t>* const to = words_ + (entry >> 32) * max_tile_words;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    if (!converted[i]) continue;
    for (std::size_t w = 0; w < count; ++w)
      to[count * texels[i] + w].store(out(i, w), std::memory_order_release);
  }
}

bool TileCache::is_resident(std::uint64_t entry) const {
  return entry != 0 &&
         slots_[entry >> 32].sequence.load(std::memory_order_relaxed) == static_cast<std::uint32_t>(entry);
}

}  // namespace vitrail
