// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/medium.h"

namespace vitrail::mitsuba_writer {

// Writes the grid's values as one of Mitsuba's volume files (.vol, version 3, 32-bit floats). Throws
// MachineError.
void write_volume_file(const std::filesystem::path& path, const Grid& grid);

}  // namespace vitrail::mitsuba_writer
