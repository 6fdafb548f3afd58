// SPDX-License-Identifier: Apache-2.0
// A file without a name in the folder for temporary files: for what memory is too small for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

namespace vitrail {

// These throw MachineError that calls what is in the file `what`; from any thread.
std::FILE* open_temporary(const char* what);
void write_at(std::FILE* file, std::uint64_t offset, std::span<const std::byte> bytes, const char* what);
void read_at(std::FILE* file, std::uint64_t offset, std::span<std::byte> bytes, const char* what);

}  // namespace vitrail
