// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "importers/reading/import_options.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Reads a scene of Mitsuba 3, or of its versions 0.5 to 2: plugins become records of the Scene, analytic
// shapes and curves triangles. A scene without a sensor gets a view of all of it. Diagnostics say what is not
// exact. Throws Error with their place for malformed files and references, and UsageError where the scene
// does not have the sensor.
ImportedScene read_mitsuba(const std::filesystem::path& file, MeshMemory memory = MeshMemory{},
                           const ImportOptions& options = {});

}  // namespace vitrail
