// SPDX-License-Identifier: Apache-2.0
// These functions watch files that stay mapped: what was verified once must not change while it is traced.
#pragma once

#include <sys/stat.h>

#include <filesystem>

namespace vitrail {

// Watches an open file. It has to be called each time before the file is mapped, with the result of fstat.
// Any thread may call it.
void watch(const std::filesystem::path& file, const struct stat& now);

// Returns a watched file that has another size or time of modification than when it was first mapped; null:
// none. A signal handler may call it. A file that is gone, or replaced by another, stays mapped as it was
// verified. What takes its place is verified when it is mapped.
const char* changed_file();

// It is the message about such a file.
inline constexpr char file_changed[] =
    "this file changed during the render: the samples after the last checkpoint may be wrong, and are not "
    "written";

// Throws Error where a watched file has changed.
void require_unchanged_files();

}  // namespace vitrail
