// SPDX-License-Identifier: Apache-2.0
// These functions check an output before the work for it begins. If it is a symbolic link, the file behind it
// counts.
#pragma once

#include <cstdint>
#include <filesystem>

namespace vitrail {

// Throws MachineError where the folder of `file` is missing (no program makes folders that were not asked
// for) or cannot be written to.
void require_folder_of(const std::filesystem::path& file);

// Throws UsageError where the name leaves no room for that of the temporary file or folder beside it.
void require_short_name(const std::filesystem::path& file);

// Checks both, and throws MachineError where the name is a folder's. Throws UsageError where it was read
// (is_input).
void require_place(const std::filesystem::path& file);

// Throws MachineError where the disk of `file` has less than that left.
void require_room(const std::filesystem::path& file, std::uint64_t bytes);

}  // namespace vitrail
