// SPDX-License-Identifier: Apache-2.0
// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace vitrail {

// Appends to a temporary file beside `target`; `commit` syncs it, renames it to the target and syncs the
// name. `commit_part` only renames: the file is one of many, and the next `commit` of the program, of a file
// in the same file system that speaks of them, first waits for all of them together (16,000 meshes on a busy
// disk: 22 s in place of 150). Without a commit the destructor removes it. Every failure (no space, no
// permission) throws MachineError with the file and the reason. A target that the program has read
// (input_files.h) throws UsageError. Of a symbolic link the file behind it is replaced; the link stays.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  // Over what was written there.
  void write_at(std::uint64_t place, std::span<const std::byte> bytes);
  std::uint64_t size() const { return size_; }
  void commit();
  void commit_part();

 private:
  void sync() const;
  void rename_to_target();

  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

// The file that a symbolic link stands for, there or not; another file itself. What lies beside an output
// while it is made lies beside that file. Throws MachineError for links that lead to each other.
std::filesystem::path behind_links(std::filesystem::path file);

// Removes what killed writers of `target` left of their temporary files. Only for who knows that nobody
// writes it now.
void remove_temporaries(const std::filesystem::path& target);

// Waits until a file's content, or a directory's names, are on the disk. Throws MachineError.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace vitrail
