// SPDX-License-Identifier: Apache-2.0
// A NanoVDB file has segments of grids, each as it lies in memory, or deflated.
#pragma once

#include <nanovdb/util/IO.h>

#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail::nanovdb_file {

// It is a file that a stranger wrote.
class File {
 public:
  // Throws Error where the file cannot be opened.
  explicit File(const std::filesystem::path& path);

  // Reads to.size() bytes from `offset` on. Throws Error where the file ends before.
  void read(std::uint64_t offset, std::span<char> to) const;
  template <class T>
  T at(std::uint64_t offset) const {
    static_assert(std::is_trivially_copyable_v<T>);
    char bytes[sizeof(T)];
    read(offset, bytes);
    return std::bit_cast<T>(bytes);
  }
  std::uint64_t size() const { return file_.size(); }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::filesystem::path path_;
  RegularFile file_;
};

// It is a grid in the file.
struct StoredGrid {
  nanovdb::io::MetaData meta;
  std::uint64_t offset = 0;  // of its bytes, meta.fileSize of them
};

// Returns the first grid of that name, or nothing.
std::optional<StoredGrid> find_grid(const File& file, const std::string& name);

// Returns the first bytes of the grid as it lies in memory: `most` of them, or all if there are fewer.
std::vector<char> unpacked(const StoredGrid& grid, std::uint64_t most, const File& file);

}  // namespace vitrail::nanovdb_file
