// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Gives geometry a camera that sees all of it, from the front and a little from above (+y is up), and, where
// nothing in it shines, a constant white sky of radiance 1; diagnostics say so.
void add_default_view(ImportedScene& imported, const std::filesystem::path& file);

}  // namespace vitrail
