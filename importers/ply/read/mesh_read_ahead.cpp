// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/read/mesh_read_ahead.h"

#include <algorithm>

#include "scene/system/memory_guard.h"

namespace vitrail {

MeshReadAhead::~MeshReadAhead() {
  const GrantedMemory in_any_case;
  for (const auto& entry : entries_) entry->claimed = true;
  while (!entries_.empty()) drop_first();
}

bool MeshReadAhead::expect(const std::filesystem::path& file) {
  if (expected_.contains(file.string())) return true;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return true;
  const std::uint64_t bytes = std::filesystem::file_size(file, error);
  if (error) return true;
  if (bytes_ + bytes > most_bytes_) return false;
  bytes_ += bytes;
  expected_.insert(file.string());
  Entry& entry = *entries_.emplace_back(std::make_unique<Entry>());
  entry.file = file;
  entry.bytes = bytes;
  entry.task.run([this, &entry] {
    if (entry.claimed.exchange(true)) return;
    try {
      entry.result = reader_(entry.file);
    } catch (...) {
      entry.error = std::current_exception();
    }
  });
  return true;
}

void MeshReadAhead::drop_first() {
  Entry& entry = *entries_.front();
  entry.claimed = true;
  entry.task.wait();
  bytes_ -= entry.bytes;
  entries_.pop_front();
}

MeshReadAhead::Result MeshReadAhead::take(const std::filesystem::path& file) {
  const auto found = std::ranges::find(entries_, file, [](const auto& entry) { return entry->file; });
  if (found == entries_.end()) return reader_(file);
  for (auto skipped = found - entries_.begin(); skipped > 0; --skipped) drop_first();
  Entry& entry = *entries_.front();
  const bool read_by_task = entry.claimed.exchange(true);
  entry.task.wait();
  const std::exception_ptr error = entry.error;
  Result result = std::move(entry.result);
  drop_first();
  if (error) std::rethrow_exception(error);
  return read_by_task ? std::move(result) : reader_(file);
}

}  // namespace vitrail
