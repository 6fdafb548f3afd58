// SPDX-License-Identifier: Apache-2.0
// Normal maps with factors (scene/models/normal_map.h), for formats whose maps have none.
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

bool has_scaled_normals(const Scene& scene);

// Writes each as an image of its own to OUT-normals/000000.exr … beside `out`, and names it in the texture's
// place. An image that cannot be read throws Error with the place of its texture; MachineError.
void write_scaled_normals(Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
