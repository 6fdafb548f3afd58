// SPDX-License-Identifier: Apache-2.0
// Scenes in which something else than meshes takes the memory: each of one thing, very many times.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vitrail::test {

struct MemoryRow {
  std::string what;
  std::uint64_t budget_bytes = 0;
  std::string options;  // of `partition`
  // Writes the scene with `share` of the things; returns its file.
  std::function<std::filesystem::path(const std::filesystem::path& directory, double share)> write;
  bool images = false;  // reads some
};

std::vector<MemoryRow> memory_rows();

}  // namespace vitrail::test
