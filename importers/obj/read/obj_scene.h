// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "importers/obj/read/obj_parser.h"

namespace vitrail::obj {

// Makes one mesh and shape a group, with the materials that are used; `offset` is what was subtracted from
// positions. Libraries are sought beside `file`; those that are not there are reported.
ImportedScene to_scene(Geometry&& geometry, Vector3d offset, const std::filesystem::path& file);

}  // namespace vitrail::obj
