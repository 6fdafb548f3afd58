// SPDX-License-Identifier: Apache-2.0
// The door of files: what a user names, and what that names in turn, is opened here. What a program has read,
// it must not write over.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>

namespace vitrail {

// An open regular file. A pipe or a device would be waited for, or read without end.
class RegularFile {
 public:
  // Throws Error for what is there and is no regular file, or a pointer of Git LFS in its place. `reason` is
  // errno where it cannot be opened.
  explicit RegularFile(const std::filesystem::path& file);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int reason() const { return reason_; }
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return static_cast<std::uint64_t>(status_.st_size); }
  // As it was when it was opened.
  const struct stat& status() const { return status_; }
  // False where the file ends before, or cannot be read.
  bool read(std::span<std::byte> to, std::uint64_t offset) const;

 private:
  bool is_lfs_pointer() const;

  int descriptor_ = -1, reason_ = 0;
  struct stat status_ = {};
};

// As a stream, which is not open where there is no such file.
std::ifstream open_regular(const std::filesystem::path& file);

// Files that a scene names are to lie within that folder, links resolved: others throw Error from now on.
// Throws UsageError where it is no folder.
void confine_inputs(const std::filesystem::path& folder);
// Throws Error where it does not.
void require_confined(const std::filesystem::path& file);

// Before a library opens a file by its name: notes it, and throws Error where it is not within the folder, or
// is there and not regular.
void check_input(const std::filesystem::path& file);
// The same, opened as open_regular does.
std::ifstream open_input(const std::filesystem::path& file);

// A program asks for it before it reads anything; until then nothing is noted.
void protect_inputs();

// Every reader of a user's file tells of it here, from any thread. A file is known by device and inode, not
// by its name. What does not exist is ignored.
void note_input(const std::filesystem::path& file);

// Whether a file of this name, itself or behind a link, is one of them.
bool is_input(const std::filesystem::path& file);

}  // namespace vitrail
