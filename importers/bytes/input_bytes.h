// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

#include "importers/bytes/growing_array.h"

struct gzFile_s;

namespace vitrail {

// It holds the bytes of an input file, mapped, or inflated where the file is gzipped (by content, whatever
// its name). They stay at their address for the life of the object. A file that cannot be opened or inflated,
// is not regular, is outside of what may be read (scene/system/input_files.h), or inflates to more than 128
// times its size (and 64 MiB) or than half of the machine's memory, throws Error.
class InputBytes {
 public:
  explicit InputBytes(const std::filesystem::path& file);
  ~InputBytes();
  InputBytes(const InputBytes&) = delete;
  InputBytes& operator=(const InputBytes&) = delete;

  const char* begin() const { return begin_; }
  const char* end() const { return begin_ + size_; }
  std::size_t size() const { return size_; }

  // Lets the pages before `position` leave memory. They come back from the file if they are read again.
  // Positions increase, or begin anew where the file is read once more.
  void release_before(const char* position);
  // Releases the pages between two positions, once these are a few megabytes apart: `begin` then moves on.
  // Threads may each release what they have read themselves.
  void release(const char*& begin, const char* end) const;

 private:
  void map(int descriptor, std::size_t size);
  void inflate(gzFile_s* input, const std::filesystem::path& file, std::size_t limit);

  const char* begin_ = nullptr;
  std::size_t size_ = 0;
  std::size_t released_ = 0;
  bool mapped_ = false;
  GrowingArray<char> inflated_;
};

}  // namespace vitrail
