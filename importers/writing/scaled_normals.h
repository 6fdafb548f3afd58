// SPDX-License-Identifier: Apache-2.0
// Normal maps may have factors (scene/models/normal_map.h). These functions serve formats whose maps have
// none.
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

bool has_scaled_normals(const Scene& scene);

// Writes each as an image of its own to OUT-normals/000000.exr … beside `out`, and names it in the texture's
// place. Throws Error with the place of its texture where an image cannot be read, and MachineError.
void write_scaled_normals(Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
