// SPDX-License-Identifier: Apache-2.0
// Scenes that take memory: each by one thing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vitrail::test {

constexpr std::uint64_t mib = 1 << 20;

struct MemoryRow {
  std::string what;
  std::uint64_t budget_bytes = 0;
  std::string options;  // of `partition`
  // Writes the scene with `share` of the things; returns its file.
  std::function<std::filesystem::path(const std::filesystem::path& directory, double share)> write;
  bool images = false;  // reads some
};

std::vector<MemoryRow> memory_record_rows();  // very many small things
std::vector<MemoryRow> memory_file_rows();    // large files

}  // namespace vitrail::test
