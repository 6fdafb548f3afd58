// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "scene/records/medium.h"

namespace vitrail::mitsuba {

// Before the values, which are 32-bit floats, x fastest.
inline constexpr int volume_header_bytes = 48;

// What the header of one of Mitsuba's volume files (.vol, version 3, 32-bit floats) says: size, channels and
// bounds of the grid; its values stay in the file. Throws std::runtime_error that says what is wrong, also
// where the file is too short for its counts.
Grid read_volume_header(const std::filesystem::path& path);

}  // namespace vitrail::mitsuba
