// SPDX-License-Identifier: Apache-2.0
// Files that stay mapped: what was verified once must not change while it is traced.
#pragma once

#include <sys/stat.h>

#include <filesystem>

namespace vitrail {

// To be called before an open file is mapped, each time, with what fstat says of it. Any thread may.
void watch(const std::filesystem::path& file, const struct stat& now);

// A watched file that has another size or time of modification than when it was first mapped; null: none. A
// signal handler may ask. One that is gone, or has another in its place, goes on to exist where it is mapped,
// as it was verified; and what takes its place is verified when it is mapped.
const char* changed_file();

// What there is to say of such a file.
inline constexpr char file_changed[] =
    "this file changed during the render: the samples after the last checkpoint may be wrong, and are not "
    "written";

// Throws Error where a watched file has changed.
void require_unchanged_files();

}  // namespace vitrail
