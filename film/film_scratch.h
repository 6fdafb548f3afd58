// SPDX-License-Identifier: Apache-2.0
// A film that is larger than its share of memory lies in mapped files of the scratch directory. Its sums are
// where they would be in memory, and the system writes and reads pages. When a window of pages has been used,
// all are given back to the files: no more than the window counts as memory of this process.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace vitrail {

class FilmScratch {
 public:
  static constexpr std::uint64_t least_window_bytes = 16 << 20;

  // `window_bytes` is that of pages in memory, at least least_window_bytes. A thread that waits for
  // its turn may have one page more.
  explicit FilmScratch(std::uint64_t window_bytes);
  ~FilmScratch();
  FilmScratch(const FilmScratch&) = delete;
  FilmScratch& operator=(const FilmScratch&) = delete;

  // Returns zero bytes of a file that has room for all of them. Throws MachineError where it has none.
  void* allocate(std::size_t bytes);
  void deallocate(void* at, std::size_t bytes);

  // Call it before writing bytes that lie in one page or two. Safe from many threads.
  void writes(const void* at, std::size_t bytes) {
    const auto first = reinterpret_cast<std::uintptr_t>(at) / page_bytes_,
               last = (reinterpret_cast<std::uintptr_t>(at) + bytes - 1) / page_bytes_;
    use(first, 1);
    if (last != first) use(last, 1);
  }
  // Call it before reading them; the system may then bring the pages about them too.
  void reads(const void* at, std::size_t bytes) {
    const auto first = reinterpret_cast<std::uintptr_t>(at) / around_bytes,
               last = (reinterpret_cast<std::uintptr_t>(at) + bytes - 1) / around_bytes;
    use(first | of_many, around_bytes / page_bytes_);
    if (last != first) use(last | of_many, around_bytes / page_bytes_);
  }
  // Gives all pages back to the files; no sum is lost.
  void leave();
  // Has the system read bytes from the files before they are used: else it reads page by page.
  void read_ahead(const void* at, std::size_t bytes);

  // Returns the bytes of the files, so far.
  std::uint64_t file_bytes() const { return file_bytes_; }
  // Returns memory beside the window: its pages' slots, and the system's tables of so large a mapping.
  static std::uint64_t table_bytes(std::uint64_t window_bytes, std::uint64_t film_bytes);

 private:
  // A fault that reads maps what the system has of so many bytes about it.
  static constexpr std::uintptr_t around_bytes = 64 << 10, of_many = std::uintptr_t{1} << 63;
  struct Mapping {
    void* at;
    std::size_t bytes;
  };
  // Uses a page, or as many as `pages` about one; such a group has a number of its own.
  void use(std::uintptr_t place, std::uint64_t pages) {
    std::atomic<std::uintptr_t>& slot = slots_[place * 0x9E3779B97F4A7C15u >> shift_];
    if (slot.load(std::memory_order_relaxed) != place) begin_to_use(slot, place, pages);
  }
  void begin_to_use(std::atomic<std::uintptr_t>& slot, std::uintptr_t place, std::uint64_t pages);
  void give_back();

  std::uintptr_t page_bytes_;
  std::uint64_t most_pages_;
  int shift_;
  // They are places that may be in memory. One that takes another's slot is counted again: never too few are.
  std::unique_ptr<std::atomic<std::uintptr_t>[]> slots_;
  std::atomic<std::uint64_t> used_ = 0;
  std::mutex giving_back_;
  std::vector<Mapping> mappings_;
  std::uint64_t file_bytes_ = 0;
};

// Visits all of an array part by part, and gives the pages back after each part. An array in memory
// (scratch null) is visited at once.
inline constexpr std::size_t scratch_part_bytes = 2 << 20;
template <class T, class Visit>
void in_parts(std::span<T> all, FilmScratch* scratch, Visit&& visit) {
  if (!scratch) return visit(all);
  constexpr std::size_t part = scratch_part_bytes / sizeof(T);
  scratch->leave();
  for (std::size_t at = 0; at < all.size(); at += part) {
    const std::span<T> here = all.subspan(at, std::min(part, all.size() - at));
    scratch->read_ahead(here.data(), here.size_bytes());
    visit(here);
    scratch->leave();
  }
}

}  // namespace vitrail
