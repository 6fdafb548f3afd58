// SPDX-License-Identifier: Apache-2.0
// Images may lie within another file (images/file_part.h). These functions serve formats that refer to files.
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

bool has_embedded_images(const Scene& scene);

// Writes each as it is to OUT-images/000000.png … beside `out`, and names the records' files so. Throws Error
// with the place of its texture where one cannot be read, and MachineError.
void extract_images(Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
