// SPDX-License-Identifier: Apache-2.0
// A PLY file is a scene by itself, but for its view.
#pragma once

#include <filesystem>

#include "importers/reading/skimmed_scene.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Returns one diffuse mesh. Its reflectance is the first of: the image that "comment TextureFile NAME" names,
// which is sought beside the file and needs (u,v); the colours of vertices or faces; 0.5.
ImportedScene read_ply_scene(const std::filesystem::path& file, MeshMemory memory);

// Counts the mesh by the file's header.
SkimmedScene skim_ply_scene(const std::filesystem::path& file);

}  // namespace vitrail
