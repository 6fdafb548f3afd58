// SPDX-License-Identifier: Apache-2.0
#include "importers/bytes/input_bytes.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

bool starts_gzip(int descriptor) {
  unsigned char magic[2] = {};
  return ::pread(descriptor, magic, 2, 0) == 2 && magic[0] == 0x1f && magic[1] == 0x8b;
}

// What a gzipped file may hold. Text and meshes deflate to between a third and a twentieth; a bomb
// of one byte repeated to a thousandth. And half of the machine's memory, because all of it is held.
std::size_t most_inflated(std::uint64_t file_bytes) {
  constexpr std::size_t always = std::size_t{64} << 20, most_ratio = 128;
  const auto pages = static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES));
  const std::size_t half_memory = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) / 2;
  return std::min(half_memory, std::max(always, most_ratio * file_bytes));
}

}  // namespace

InputBytes::InputBytes(const std::filesystem::path& file) {
  require_confined(file);
  note_input(file);
  const RegularFile input(file);
  if (!input.is_open())
    throw Error(fmt::format("cannot open the file: {}", std::strerror(input.reason())), {file.string()});
  if (input.size() > 0 && !starts_gzip(input.descriptor())) map(input.descriptor(), input.size());
  if (mapped_) return;
  // zlib's reader, which closes what it is given, passes what is not gzipped through as it is.
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> reader(::gzdopen(::dup(input.descriptor()), "rb"),
                                                          &::gzclose);
  if (!reader) throw std::bad_alloc();
  inflate(reader.get(), file, most_inflated(input.size()));
}

InputBytes::~InputBytes() {
  if (mapped_) ::munmap(const_cast<char*>(begin_), size_);
}

void InputBytes::map(int descriptor, std::size_t size) {
  void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  if (address == MAP_FAILED) return;
  ::madvise(address, size, MADV_SEQUENTIAL);
  begin_ = static_cast<const char*>(address);
  size_ = size;
  mapped_ = true;
}

void InputBytes::inflate(gzFile_s* input, const std::filesystem::path& file, std::size_t limit) {
  constexpr unsigned chunk = 1u << 20;
  ::gzbuffer(input, chunk);
  const auto buffer = std::make_unique<char[]>(chunk);
  for (;;) {
    const int got = ::gzread(input, buffer.get(), chunk);
    if (got > 0) inflated_.append({buffer.get(), static_cast<std::size_t>(got)});
    int code = Z_OK;
    const char* const reason = ::gzerror(input, &code);
    if (got < 0 || (code != Z_OK && code != Z_STREAM_END)) {
      throw Error(fmt::format("cannot inflate the file after {} bytes: {}", inflated_.size(), reason),
                  {file.string()});
    }
    if (inflated_.size() > limit) {
      throw Error(
          fmt::format(
              "the file inflates to more than {} MiB, which no mesh or scene of its size does: inflate "
              "it first if it is sound",
              limit >> 20),
          {file.string()});
    }
    if (got == 0) break;
  }
  begin_ = inflated_.begin();
  size_ = inflated_.size();
}

void InputBytes::release_before(const char* position) {
  const char* begin = begin_ + released_;
  if (position < begin) begin = begin_;
  release(begin, position);
  released_ = static_cast<std::size_t>(begin - begin_);
}

void InputBytes::release(const char*& begin, const char* end) const {
  // A multiple of every page size. Less than the guard of memory keeps in reserve, which sees no mapped page.
  constexpr std::size_t step = std::size_t{1} << 19;
  const std::size_t from = (static_cast<std::size_t>(begin - begin_) + step - 1) / step * step;
  const std::size_t to = static_cast<std::size_t>(end - begin_) / step * step;
  if (to <= from) return;
  if (mapped_) ::madvise(const_cast<char*>(begin_) + from, to - from, MADV_DONTNEED);
  begin = begin_ + to;
}

}  // namespace vitrail
