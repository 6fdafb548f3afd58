// SPDX-License-Identifier: Apache-2.0
// What reads a file in bench_import: Vitrail's importers, others', and reading alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::bench {

// What a reader did with a file, measured in a process of its own.
struct Measurement {
  double seconds = 0;
  double cpu_seconds = 0;         // of all threads
  std::uint64_t peak_bytes = 0;   // resident, above what the process held before
  std::uint64_t final_bytes = 0;  // of the mesh; 0 for what makes none of ours
  std::uint64_t triangles = 0;
  std::uint64_t digest = 0;  // of the triangles' corners by value, whatever their indices
};

// "vitrail", "read" (through a buffer), "load" (into fresh memory of the file's size), and where they were
// there to build with "tinyobjloader" and "assimp".
std::vector<std::string> readers();

// In this process. Throws where the reader fails.
Measurement measure(const std::string& reader, const std::filesystem::path& file);

}  // namespace vitrail::bench
