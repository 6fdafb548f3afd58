// SPDX-License-Identifier: Apache-2.0
// These functions keep data that memory is too small for in a nameless file in the folder for temporary
// files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

namespace vitrail {

// These throw MachineError, whose message calls the content of the file `what`. They may be called from any
// thread.
std::FILE* open_temporary(const char* what);
void write_at(std::FILE* file, std::uint64_t offset, std::span<const std::byte> bytes, const char* what);
void read_at(std::FILE* file, std::uint64_t offset, std::span<std::byte> bytes, const char* what);

}  // namespace vitrail
