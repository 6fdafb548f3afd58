// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Writes a scene for pbrt-v4: `out` and, beside it, OUT-meshes/ with binary PLY for all but small meshes.
// read_pbrt gives the same scene back, but for what the diagnostics say: each has the place where the record
// comes from. Throws MachineError.
Diagnostics write_pbrt(const Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
