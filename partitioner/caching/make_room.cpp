// SPDX-License-Identifier: Apache-2.0
#include "partitioner/caching/make_room.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <vector>

namespace vitrail {

namespace fs = std::filesystem;

namespace {

std::uint64_t bytes_in(const fs::path& folder) {
  std::uint64_t sum = 0;
  std::error_code gone;  // others remove entries too
  for (fs::recursive_directory_iterator at(folder, gone), end; !gone && at != end; at.increment(gone)) {
    std::error_code failed;
    if (const std::uintmax_t bytes = at->is_regular_file(failed) ? at->file_size(failed) : 0; !failed)
      sum += bytes;
  }
  return sum;
}

struct Entry {
  fs::file_time_type used;
  fs::path path;
  std::uint64_t bytes;
};

}  // namespace

void make_room(const fs::path& folder, std::uint64_t most_bytes) {
  std::vector<Entry> entries;
  std::uint64_t sum = 0;
  std::error_code gone;  // others remove entries too
  for (fs::directory_iterator at(folder, gone), end; !gone && at != end; at.increment(gone)) {
    std::error_code failed;
    const auto used = at->last_write_time(failed);
    if (failed) continue;
    const std::uint64_t bytes = at->is_directory(failed) ? bytes_in(at->path()) : at->file_size(failed);
    if (failed) continue;
    entries.push_back({used, at->path(), bytes});
    sum += bytes;
  }
  std::ranges::sort(entries, {}, &Entry::used);
  const auto abandoned = fs::file_time_type::clock::now() - std::chrono::hours(24);
  for (const Entry& entry : entries) {
    if (sum <= most_bytes && !(entry.path.has_extension() && entry.used < abandoned)) continue;
    fs::remove_all(entry.path, gone);
    sum -= entry.bytes;
  }
}

}  // namespace vitrail
