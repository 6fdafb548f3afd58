// SPDX-License-Identifier: Apache-2.0
// This reader takes glTF 2.0: .gltf with its buffers and images, or .glb.
#pragma once

#include <filesystem>
#include <string_view>

#include "importers/reading/import_options.h"
#include "scene/records/scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

// Returns whether a file is glTF by its first bytes.
bool is_gltf(std::string_view first_bytes);

// Reads the scene that the file shows first, as it stands at rest: skins and morph targets are bent,
// animations are not run. A mesh that several nodes use, or EXT_mesh_gpu_instancing, is a prototype. The
// camera is the first one, or ImportOptions::camera of them; without one the scene gets a view of all of it,
// without light a sky. materials.h lists the materials. Light is in candela, lux and cd/m²; a picture's
// numbers are cd/m² where the file has light. Throws Error with the place in the file's JSON for wrong
// references, data beyond its buffer, numbers that are not finite, and extensions that are required and
// unknown; UsageError where there is no such camera.
ImportedScene read_gltf(const std::filesystem::path& file, MeshMemory memory = MeshMemory{},
                        const ImportOptions& options = {});

}  // namespace vitrail
