// SPDX-License-Identifier: Apache-2.0
// The cache keeps files that took time to make, for the next time.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace vitrail {

// Returns $XDG_CACHE_HOME/vitrail, else ~/.cache/vitrail; empty where neither is an absolute path.
std::filesystem::path cache_folder();

// A FileCache is a folder of entries, each a file named by its key: a header of 4 KiB, then the kept content.
// The key has to tell the content: an entry is never changed. Entries appear whole (by renaming) and carry
// checksums; one that is damaged counts as missing and is removed. Any number of processes may use a folder
// at once. An entry that cannot be read, written or made room for is as if it were not kept. Nothing here
// throws but std::bad_alloc, and `take` a MachineError for its target.
class FileCache {
 public:
  // A Note has the maker's own numbers beside the content.
  using Note = std::array<std::uint64_t, 4>;

  static constexpr std::uint64_t usual_most_bytes = std::uint64_t{4} << 30;

  // Nothing is kept where `folder` is empty. It is made with the first entry.
  explicit FileCache(std::filesystem::path folder, std::uint64_t most_bytes = usual_most_bytes);

  bool is_on() const { return !folder_.empty(); }
  // Returns the note of an entry whose header is whole.
  std::optional<Note> note(const std::string& key) const;
  // Copies the content to a new file and checks it on the way. The entry becomes the one used last.
  std::optional<Note> take(const std::string& key, const std::filesystem::path& to) const;
  // Keeps a file's content, then removes entries until all are within `most_bytes`,
  // those used longest ago first.
  void keep(const std::string& key, const std::filesystem::path& from, const Note& note) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
};

}  // namespace vitrail
