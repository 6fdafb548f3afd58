// SPDX-License-Identifier: Apache-2.0
// This function keeps a cache's folder within its size.
#pragma once

#include <cstdint>
#include <filesystem>

namespace vitrail {

// Removes entries (files, or folders with files) until all are within `most_bytes`, those used longest ago
// first. Removes those too that have an extension and are a day old: their maker was killed. Throws nothing
// but std::bad_alloc: entries that cannot be read or removed stay.
void make_room(const std::filesystem::path& folder, std::uint64_t most_bytes);

}  // namespace vitrail
