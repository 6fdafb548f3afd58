// SPDX-License-Identifier: Apache-2.0
// Images that lie within another file (images/file_part.h), for formats that refer to files.
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

bool has_embedded_images(const Scene& scene);

// Writes each as it is to OUT-images/000000.png … beside `out`, and names the records' files so. One that
// cannot be read throws Error with the place of its texture; MachineError.
void extract_images(Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
