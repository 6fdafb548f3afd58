// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "importers/assimp/asset.h"
#include "importers/obj/read/mtl.h"

namespace vitrail::assimp {

// Appends the records of all materials of the asset, in its order; `file` is where it comes from. An image in
// the file itself is named by its bytes there (images/file_part.h).
std::vector<MtlSurface> add_materials(const Asset& asset, const std::string& file, ImportedScene& imported);

}  // namespace vitrail::assimp
