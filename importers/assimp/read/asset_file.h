// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "importers/assimp/asset.h"

namespace vitrail::assimp {

// Reads a file by the module. All that the asset refers to is there: meshes of nodes, parents, materials,
// positions of triangles. Throws MachineError where the module is missing, Error where the file cannot be
// read.
Asset read_asset(const std::filesystem::path& file);

}  // namespace vitrail::assimp
