// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/input_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <new>

#include "scene/diagnostics.h"

namespace vitrail {

namespace {

bool starts_gzip(int descriptor) {
  unsigned char magic[2] = {};
  return ::pread(descriptor, magic, 2, 0) == 2 && magic[0] == 0x1f && magic[1] == 0x8b;
}

}  // namespace

InputBytes::InputBytes(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status = {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
    const int reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    throw Error(fmt::format("cannot open the file: {}", std::strerror(reason)), {file.string()});
  }
  // zlib's reader, which closes what it is given, passes what is not gzipped through as it is: pipes too.
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> reader(::gzdopen(descriptor, "rb"), &::gzclose);
  if (!reader) throw std::bad_alloc();
  if (S_ISDIR(status.st_mode)) throw Error("this is a directory, not a file", {file.string()});
  const bool mappable = S_ISREG(status.st_mode) && status.st_size > 0 && !starts_gzip(descriptor);
  if (mappable) map(descriptor, static_cast<std::size_t>(status.st_size));
  if (!mapped_) inflate(reader.get(), file);
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

void InputBytes::inflate(gzFile_s* input, const std::filesystem::path& file) {
  constexpr unsigned chunk = 1u << 20;
  ::gzbuffer(input, chunk);
  const auto buffer = std::make_unique<char[]>(chunk);
  for (;;) {
    const int got = ::gzread(input, buffer.get(), chunk);
    if (got > 0) inflated_.insert(inflated_.end(), buffer.get(), buffer.get() + got);
    int code = Z_OK;
    const char* const reason = ::gzerror(input, &code);
    if (got < 0 || (code != Z_OK && code != Z_STREAM_END)) {
      throw Error(fmt::format("cannot inflate the file after {} bytes: {}", inflated_.size(), reason),
                  {file.string()});
    }
    if (got == 0) break;
  }
  begin_ = inflated_.data();
  size_ = inflated_.size();
}

void InputBytes::release_before(const char* position) {
  constexpr std::size_t step = std::size_t{4} << 20;  // a multiple of every page size
  const auto consumed = static_cast<std::size_t>(position - begin_) / step * step;
  if (mapped_ && consumed > released_) {
    ::madvise(const_cast<char*>(begin_) + released_, consumed - released_, MADV_DONTNEED);
  }
  released_ = consumed;
}

}  // namespace vitrail
