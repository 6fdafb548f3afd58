// SPDX-License-Identifier: Apache-2.0
// These files appear whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace vitrail {

// It appends to a temporary file beside `target`; `commit` syncs it, renames it to the target and syncs the
// name. `commit_part` only renames: the file is one of many, and the next `commit` of the program, of a file
// in the same file system that speaks of them, first waits for all of them together (16,000 meshes on a busy
// disk: 22 s in place of 150). Without a commit the destructor removes it. Every failure (no space, no
// permission) throws MachineError with the file and the reason. A target that the program has read
// (input_files.h) throws UsageError. If the target is a symbolic link, the file behind it is replaced; the
// link stays.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  // Overwrites what was written at `place`.
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

// Returns the file that a symbolic link stands for, whether or not that file exists; any other file is
// returned as it is. Files that lie beside an output while it is made lie beside the returned file. Throws
// MachineError for links that lead to each other.
std::filesystem::path behind_links(std::filesystem::path file);

// Removes the temporary files that killed writers of `target` left. Call it only where nobody writes `target`
// now.
void remove_temporaries(const std::filesystem::path& target);

// Waits until a file's content, or a directory's names, are on the disk. Throws MachineError.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace vitrail
