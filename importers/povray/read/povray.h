// SPDX-License-Identifier: Apache-2.0
// This reader takes the scene files of POV-Ray 3.7 and of the versions before.
#pragma once

#include <filesystem>

#include "importers/reading/import_options.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Reads a scene with all that it includes (povray/read/search.h says from where). Bad input throws Error with
// its place and the macros and files that lead there. Of the options include_limit, include_folders,
// for_export and program count.
ImportedScene read_povray(const std::filesystem::path& file, MeshMemory memory = MeshMemory{},
                          const ImportOptions& options = {});

}  // namespace vitrail
