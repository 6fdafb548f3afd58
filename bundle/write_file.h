// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

#include "bundle/byte_stream.h"

namespace vitrail {

// Writes the parts one after the other, without syncing. A failure (no space, no permission) throws
// MachineError with the file and the reason, and removes the file.
void write_file(const std::filesystem::path& file, std::span<const std::span<const std::byte>> parts);
// Writes what `content` gives to the sink.
void write_file(const std::filesystem::path& file, const std::function<void(const ByteSink&)>& content);

}  // namespace vitrail
