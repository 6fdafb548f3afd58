// SPDX-License-Identifier: Apache-2.0
// This reader takes the scene files of pbrt, versions 3 and 4.
#pragma once

#include <filesystem>
#include <functional>

#include "importers/reading/import_options.h"
#include "importers/reading/skimmed_scene.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Reads a scene with all that it includes, plain or gzipped. Both syntaxes are read. Where a word means
// different things, the first word of the main file that only one version knows decides
// (importers/README.md). Bad input throws Error with its place. A file without WorldBegin is a part of a
// scene: it gets a camera and a sky. `progress`, if given, gets the fraction of the file that is read; what
// it throws stops the reading. Of the options only replace_missing, of meshes here, include_limit and
// all_media count.
ImportedScene read_pbrt(const std::filesystem::path& file, MeshMemory memory = MeshMemory{},
                        std::function<void(double)> progress = {}, const ImportOptions& options = {});

// Reads the scene but for its long lists. Throws Error as read_pbrt does, and for long lists that are neither
// a mesh's nor a grid's.
SkimmedScene skim_pbrt(const std::filesystem::path& file, std::function<void(double)> progress,
                       const ImportOptions& options);

}  // namespace vitrail
