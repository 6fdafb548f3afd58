// SPDX-License-Identifier: Apache-2.0
// A program opens here the files that a user names, and the files that those name in turn. It must not write
// over a file that it has read.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>

namespace vitrail {

// It is an open regular file. A pipe or a device is refused, since it would be waited for, or read without
// end.
class RegularFile {
 public:
  // Throws Error where `file` is there and is no regular file, or is a pointer of Git LFS. `reason` is errno
  // where it cannot be opened.
  explicit RegularFile(const std::filesystem::path& file);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int reason() const { return reason_; }
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return static_cast<std::uint64_t>(status_.st_size); }
  // It is the status that the file had when it was opened.
  const struct stat& status() const { return status_; }
  // Returns false where the file ends before `to` is full, or cannot be read.
  bool read(std::span<std::byte> to, std::uint64_t offset) const;

 private:
  bool is_lfs_pointer() const;

  int descriptor_ = -1, reason_ = 0;
  struct stat status_ = {};
};

// Returns the file as a stream, which is not open where there is no such file.
std::ifstream open_regular(const std::filesystem::path& file);

// Requires from now on that the files that a scene names lie within that folder, links resolved: others throw
// Error. Throws UsageError where it is no folder.
void confine_inputs(const std::filesystem::path& folder);
// Throws Error where the file does not lie within that folder.
void require_confined(const std::filesystem::path& file);

// Call it before a library opens a file by its name: it notes the file. It throws Error where the file is not
// within the folder, or is there and not regular.
void check_input(const std::filesystem::path& file);
// Does the same and opens the file as open_regular does.
std::ifstream open_input(const std::filesystem::path& file);

// Makes note_input note files. A program calls it before it reads anything; until then nothing is noted.
void protect_inputs();

// Notes a file that the program reads. Every reader of a user's file calls it, from any thread. A file is
// known by device and inode, not by its name. A file that does not exist is ignored.
void note_input(const std::filesystem::path& file);

// Returns whether a file of this name, itself or behind a link, was noted.
bool is_input(const std::filesystem::path& file);

}  // namespace vitrail
