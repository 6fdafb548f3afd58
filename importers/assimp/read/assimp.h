// SPDX-License-Identifier: Apache-2.0
// This reader takes FBX, COLLADA and 3DS, as assimp reads them.
#pragma once

#include <filesystem>

#include "importers/reading/import_options.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Reads the scene as the file shows it at rest: bones and animations are not run. +y is up, in the file's
// units. A mesh that several nodes use is a prototype. Materials are those of classic shading; they become
// what an MTL file with the same numbers does (obj/read/mtl.h). A light of colour c shows c·ρ·cos θ on a
// diffuse surface, divided by the file's attenuation. The camera is the first one, or ImportOptions::camera
// of them; without one the scene gets a view of all of it, without light a sky. All is read into memory.
// Throws Error where the file is none of these or a vertex is not finite, MachineError where the module
// vitrail-assimp.so is missing, and UsageError where there is no such camera.
ImportedScene read_assimp(const std::filesystem::path& file, MeshMemory memory = MeshMemory{},
                          const ImportOptions& options = {});

}  // namespace vitrail
