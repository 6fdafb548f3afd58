// SPDX-License-Identifier: Apache-2.0
// Files that stay mapped: what was verified once must not change while it is traced.
#pragma once

#include <filesystem>

namespace vitrail {

// To be called before a file is mapped, each time. Any thread may.
void watch(const std::filesystem::path& file);

// Throws Error where a watched file has another size or time of modification than when it was first
// mapped. One that is gone, or has another in its place, goes on to exist where it is mapped, as it was
// verified; and what takes its place is verified when it is mapped.
void require_unchanged_files();

}  // namespace vitrail
