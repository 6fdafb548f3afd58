// SPDX-License-Identifier: Apache-2.0
#include "film/film_scratch.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <system_error>
#include <thread>

#include "scene/system/diagnostics.h"
#include "scene/system/scratch_file.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

// Four a page, so that few take each other's place.
std::uint64_t slots_of(std::uint64_t pages) { return std::bit_ceil(4 * pages); }

std::uint64_t page_size() { return static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)); }

[[noreturn]] void fail(std::uint64_t bytes, int reason) {
  throw MachineError(fmt::format(
      "the film is too large for its share of --memory, and {} MB of it have no room in {}: {}; TMPDIR names "
      "another place, more --memory keeps the film there, and a large picture is rendered in parts with "
      "--crop",
      bytes / 1'000'000 + 1, scratch_directory().string(), std::generic_category().message(reason)));
}

}  // namespace

FilmScratch::FilmScratch(std::uint64_t window_bytes)
    : page_bytes_(page_size()),
      most_pages_(std::max(window_bytes, least_window_bytes) / page_bytes_),
      shift_(64 - std::countr_zero(slots_of(most_pages_))),
      slots_(new std::atomic<std::uintptr_t>[slots_of(most_pages_)]()) {}

FilmScratch::~FilmScratch() {
  for (const Mapping& m : mappings_) ::munmap(m.at, m.bytes);
}

std::uint64_t FilmScratch::table_bytes(std::uint64_t window_bytes, std::uint64_t film_bytes) {
  return slots_of(window_bytes / page_size()) * sizeof(std::uintptr_t) +
         film_bytes / page_size() * sizeof(void*);
}

void* FilmScratch::allocate(std::size_t bytes) {
  const Underway underway("making room for the film in the folder for temporary files");
  const int descriptor = open_scratch_file();
  if (descriptor < 0) fail(bytes, errno);
  // Where there is no room, trying would fill the disk of everybody for a moment.
  struct statvfs disk = {};
  if (::fstatvfs(descriptor, &disk) == 0 && disk.f_frsize > 0 && bytes / disk.f_frsize > disk.f_bavail) {
    ::close(descriptor);
    fail(bytes, ENOSPC);
  }
  // A disk that is full later would end the process where it writes to the mapping.
  if (const int reason = ::posix_fallocate(descriptor, 0, static_cast<off_t>(bytes)); reason != 0) {
    ::close(descriptor);
    fail(bytes, reason);
  }
  void* const at = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  const int reason = errno;
  ::close(descriptor);  // the mapping keeps the file
  if (at == MAP_FAILED) fail(bytes, reason);
  // Else the system reads ahead in large folios, and one write maps all pages of a folio: measured on Linux
  // 6.18 with ext4, a window of 101 MiB had 186 in memory.
  ::madvise(at, bytes, MADV_RANDOM);
  const std::lock_guard lock(giving_back_);
  mappings_.push_back({at, bytes});
  file_bytes_ += bytes;
  return at;
}

// Beside the thread that is done with it: a disk that is told which blocks are free (mounted with `discard`)
// held munmap for minutes, in which a rank answered nobody and its job was ended.
void FilmScratch::deallocate(void* at, std::size_t bytes) {
  {
    const std::lock_guard lock(giving_back_);
    std::erase_if(mappings_, [&](const Mapping& m) { return m.at == at; });
  }
  try {
    std::thread([at, bytes] { ::munmap(at, bytes); }).detach();
  } catch (const std::system_error&) {
    ::munmap(at, bytes);
  }
}

void FilmScratch::begin_to_use(std::atomic<std::uintptr_t>& slot, std::uintptr_t place, std::uint64_t pages) {
  slot.store(place, std::memory_order_relaxed);
  if (used_.fetch_add(pages, std::memory_order_relaxed) + pages < most_pages_) return;
  const std::lock_guard lock(giving_back_);
  if (used_.load(std::memory_order_relaxed) + pages >= most_pages_) give_back();
}

void FilmScratch::leave() {
  const std::lock_guard lock(giving_back_);
  give_back();
}

void FilmScratch::read_ahead(const void* at, std::size_t bytes) {
  const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(at), in_page = first % page_bytes_;
  // Of one request Linux 6.18 reads no more than the disk's read-ahead, 128 KiB as a rule, or than its
  // largest transfer: of 2 MiB a disk with 1280 KiB for that left 38 % to faults.
  constexpr std::size_t request = 128 << 10;
  for (std::size_t done = 0; done < bytes + in_page; done += request)
    ::madvise(reinterpret_cast<void*>(first - in_page + done), std::min(request, bytes + in_page - done),
              MADV_WILLNEED);
}

// First the list: a page that is used meanwhile is in it, or in the files.
void FilmScratch::give_back() {
  for (std::uint64_t i = 0; i < slots_of(most_pages_); ++i) slots_[i].store(0, std::memory_order_relaxed);
  used_.store(0, std::memory_order_relaxed);
  for (const Mapping& m : mappings_) ::madvise(m.at, m.bytes, MADV_DONTNEED);
}

}  // namespace vitrail
