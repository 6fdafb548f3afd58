// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "importers/reading/import_options.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Reads a scene of Mitsuba 3, or of its versions 0.5 to 2: plugins become records of the Scene, analytic
// shapes and curves triangles. A scene without a sensor gets a view of all of it. What is not exact is in the
// diagnostics; malformed files and references throw Error with their place.
// A sensor that the scene has not throws UsageError.
ImportedScene read_mitsuba(const std::filesystem::path& file, MeshMemory memory = MeshMemory{},
                           const ImportOptions& options = {});

}  // namespace vitrail
