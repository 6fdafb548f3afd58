// SPDX-License-Identifier: Apache-2.0
// A packed scene can be moved: what it refers to lies beside it.
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Copies every image, table and volume that textures, materials, lights and media refer to into OUT-files/,
// by its name (two of one name: NAME-2), and lets the scene refer to the copies. What lies below the scene's
// folder already stays. Throws Error for a file that cannot be read, MachineError where a copy cannot be
// written.
void pack_files(Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
