// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/records/medium.h"

namespace vitrail::mitsuba {

// They come before the values, which are 32-bit floats, x fastest.
inline constexpr int volume_header_bytes = 48;

// Reads the header of one of Mitsuba's volume files (.vol, version 3, 32-bit floats): size, channels and
// bounds of the grid; its values stay in the file. Throws std::runtime_error that says what is wrong, also
// where the file is too short for its counts.
Grid read_volume_header(const std::filesystem::path& path);

// They are the least, mean and greatest value of a channel, over the cells.
struct VolumeValues {
  double least = 0, mean = 0, greatest = 0;
};
// Returns them for each channel of a file whose header is `grid`. Throws std::runtime_error where it is too
// short.
std::vector<VolumeValues> values_of_volume(const Grid& grid);

}  // namespace vitrail::mitsuba
