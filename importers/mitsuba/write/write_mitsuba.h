// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Writes the Scene for Mitsuba 3: OUT.xml, OUT-meshes/ (binary PLY) and, where the Scene needs them,
// OUT-images/ and OUT-volumes/. Nothing is left to Mitsuba's defaults. Returns what the files do not say
// exactly. Throws MachineError where a file cannot be written, Error where an image that has to be converted
// cannot be read.
Diagnostics write_mitsuba(const Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
