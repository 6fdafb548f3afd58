// SPDX-License-Identifier: Apache-2.0
// Scenes of all formats are read through these functions.
#pragma once

#include <filesystem>
#include <functional>

#include "importers/reading/import_options.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Reads a scene in the format that the file's name says, or else its first bytes (readers.h). Bad input
// throws Error with its place. A file of geometry alone gets a camera that sees all of it and a constant sky,
// and diagnostics that say so. Meshes with files of their own are in memory up to the limit; the others are
// read and stay in their files (scene/shapes/deferred_mesh.h). `progress`, if given, gets the fraction that
// is read, of a pbrt scene; what it throws stops the reading. Options that the format has no use for throw
// UsageError.
ImportedScene import_scene(const std::filesystem::path& file, MeshMemory memory = MeshMemory{},
                           std::function<void(double)> progress = {}, const ImportOptions& options = {});

// They are the two halves of import_scene: the first reads the file alone, the second completes its scene.
ImportedScene read_scene_file(const std::filesystem::path& file, MeshMemory memory,
                              std::function<void(double)> progress, const ImportOptions& options);
void complete_scene(ImportedScene& imported, const ImportOptions& options);

}  // namespace vitrail
