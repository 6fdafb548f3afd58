// SPDX-License-Identifier: Apache-2.0
// The cameras of COLLADA are read by the file's own words: assimp 5.2 loses the angles of those without a
// name or with a yfov alone, and makes orthographic ones perspective.
#pragma once

#include <filesystem>
#include <vector>

#include "importers/assimp/asset.h"

namespace vitrail::assimp {

// Returns the angles and widths of the cameras of all nodes, in the order of the file. Only these fields are
// set. It is empty where the file is no XML.
std::vector<AssetCamera> collada_cameras(const std::filesystem::path& file);

}  // namespace vitrail::assimp
