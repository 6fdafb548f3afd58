// SPDX-License-Identifier: Apache-2.0
#include "scene/system/unfilled_blocks.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>

namespace vitrail {

namespace {

struct Block {
  const void* block;
  std::uintptr_t filled_to, end;  // whole pages
  std::uint64_t missing;          // bytes, when it was looked at
};

// One more than that is not counted: of blocks of a MiB, 4 GiB that nobody has written to.
constexpr std::size_t most_blocks = 4096;

std::mutex mutex;  // over all below
std::array<Block, most_blocks> blocks;
std::size_t count = 0;
std::atomic<std::uint64_t> missing_of_all{0};

std::uintptr_t page_bytes() {
  static const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  return page;
}

// What is filled stays so: most blocks are filled from their beginning, whose pages are looked at once.
void look(Block& b) {
  std::array<unsigned char, 4096> resident;
  const std::uintptr_t page = page_bytes();
  b.missing = 0;
  for (std::uintptr_t at = b.filled_to; at < b.end; at += resident.size() * page) {
    const std::size_t pages = std::min<std::size_t>(resident.size(), (b.end - at) / page);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the address of a page
    if (::mincore(reinterpret_cast<void*>(at), pages * page, resident.data()) != 0) resident.fill(0);
    for (std::size_t i = 0; i < pages; ++i)
      if (!(resident[i] & 1))
        b.missing += page;
      else if (b.missing == 0)
        b.filled_to = at + (i + 1) * page;
  }
}

void look_at_all() {
  std::uint64_t missing = 0;
  for (std::size_t i = 0; i < count;) {
    look(blocks[i]);
    missing += blocks[i].missing;
    if (blocks[i].missing == 0)
      blocks[i] = blocks[--count];
    else
      ++i;
  }
  missing_of_all = missing;
}

}  // namespace

void add_unfilled_block(const void* block, std::uint64_t bytes) noexcept {
  const std::uintptr_t page = page_bytes(), begin = reinterpret_cast<std::uintptr_t>(block),
                       first = (begin + page - 1) / page * page,
                       end = std::max(first, (begin + bytes) / page * page);
  const std::scoped_lock lock(mutex);
  if (count == most_blocks) look_at_all();
  if (count == most_blocks) return;
  blocks[count++] = {block, first, end, end - first};
  missing_of_all += end - first;
}

void remove_unfilled_block(const void* block) noexcept {
  const std::scoped_lock lock(mutex);
  const auto all_end = blocks.begin() + static_cast<std::ptrdiff_t>(count);
  const auto it = std::find_if(blocks.begin(), all_end, [&](const Block& b) { return b.block == block; });
  if (it == all_end) return;
  missing_of_all -= it->missing;
  *it = blocks[--count];
}

void forget_unfilled_blocks() noexcept {
  const std::scoped_lock lock(mutex);
  count = 0;
  missing_of_all = 0;
}

std::uint64_t unfilled_bytes() noexcept {
  const std::scoped_lock lock(mutex);
  look_at_all();
  return missing_of_all;
}

std::uint64_t most_unfilled_bytes() noexcept { return missing_of_all; }

}  // namespace vitrail
